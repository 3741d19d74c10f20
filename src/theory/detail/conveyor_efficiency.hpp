#pragma once

#include "theory/detail/slip_map.hpp"
#include "theory/efficiency.hpp"

#include <optional>
#include <vector>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// The efficiency of many conveyors, one after another; memory is reused, and so is what they share.
class ConveyorEfficiency {
  public:
    /// The answer of solve(Conveyor) to 1e-9, or nothing for inputs and motions that are left to it: extreme
    /// values and marginal motions.
    ///
    /// Without a period it is the mean over 20 batches, after 100 cycles. They have 16 cycles each at first,
    /// and twice as many until the half-width of the 95 % confidence interval is 0.01, at most 128.
    /// @param conveyor  its forces are noticeable (see weak_forces.hpp) and its values within their ranges
    std::optional<Efficiency> operator()(Conveyor const& conveyor);

  private:
    /// A phase of the period that is being followed.
    struct Note {
        PhaseKind kind;
        double start, duration;
    };
    enum class Search { found, runs_away, failed };

    Tangent follow_period(double v);
    Tangent follow_from_rest();
    Search find_fixed_point();
    Search iterate_from_rest();
    std::optional<Efficiency> solve(Conveyor const& conveyor);
    std::optional<Efficiency> average();
    double follow_cycles(Tangent& s, std::size_t& hop, int cycles);
    void join_ends();
    ModeCode mode() const;
    std::size_t first_phase() const;

    ConveyorWaves waves_;
    NormalOrbit orbit_;
    bool orbit_known_ = false;
    std::vector<Leap> leaps_;
    Instant start_{0, 0, 1};  // of the period of a motion without flights
    Hints hints_;
    std::vector<Note> notes_;
    double displacement_ = 0, derivative_ = 0;
    double v_ = 0, error_ = 0, slope_ = 0;  // of the last period: velocity at its start, Newton's step, f'
    std::vector<double> batches_;           // means of a motion without a period
    double longest_flight_ = 0;             // rad
    double guess_ = 0;
    bool guess_in_contact_ = false;
};

}  // namespace vibrotrough::theory::detail
