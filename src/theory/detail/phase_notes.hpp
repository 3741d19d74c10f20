#pragma once

#include "theory/detail/phases.hpp"
#include "theory/efficiency.hpp"

#include <vector>

// Internal to this module.
namespace vibrotrough::theory::detail {

/// The phases of a motion that is being followed, in order.
class PhaseNotes {
  public:
    void clear() { notes_.clear(); }
    std::size_t size() const { return notes_.size(); }
    /// Adds a phase; one that lasts less than shortest_phase is left out.
    /// @param hop       number of the flight and its contact that it belongs to
    /// @param from, to  rad, in the time of that hop
    /// @param v         slip velocity at its start
    void add(PhaseKind kind, std::size_t hop, double from, double to, double v, double displacement) {
        if (to - from > shortest_phase) notes_.push_back({kind, hop, from, to, v, displacement});
    }
    /// Without flights the period may start within a phase: its two parts become one.
    void join_ends();
    /// The mode of a period.
    ModeCode mode(NormalOrbit const& orbit) const;
    /// Sets the pieces and impacts of `motion`, and, if it is periodic, its phases, mode and flight number.
    void describe(Forces const& forces, NormalOrbit const& orbit, ConveyorMotion& motion) const;

  private:
    struct Note {
        PhaseKind kind;
        std::size_t hop;
        double start, end, v, displacement;
    };
    std::size_t first_phase(NormalOrbit const& orbit) const;

    std::vector<Note> notes_;
};

}  // namespace vibrotrough::theory::detail
