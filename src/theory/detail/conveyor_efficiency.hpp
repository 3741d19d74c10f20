#pragma once

#include "theory/detail/phase_notes.hpp"
#include "theory/efficiency.hpp"

#include <optional>
#include <vector>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// The efficiency of many conveyors, one after another; memory is reused, and so is what they share.
class ConveyorEfficiency {
  public:
    /// Efficiency and mode, or nothing for inputs and motions that are left to walked_motion(): extreme
    /// values and marginal motions. What was solved before does not change a bit of the answer.
    ///
    /// Without a period it is the mean over 20 batches, after 100 cycles. They have 16 cycles each at first,
    /// and twice as many until the half-width of the 95 % confidence interval is 0.01, at most 128.
    /// @param conveyor  its forces are noticeable (see weak_forces.hpp) and its values within their ranges
    std::optional<Efficiency> operator()(Conveyor const& conveyor);
    /// The same answer with its phases; without a model.
    std::optional<ConveyorMotion> motion(Conveyor const& conveyor);

  private:
    enum class Search { found, runs_away, failed };

    Tangent follow_period(double v);
    Tangent follow_from_rest();
    Search find_fixed_point();
    Search iterate_from_rest();
    std::optional<Efficiency> solve(Conveyor const& conveyor);
    std::optional<Efficiency> average();
    double follow_cycles(Tangent& s, std::size_t& hop, int cycles);

    ConveyorWaves waves_;
    NormalOrbit orbit_;
    bool orbit_known_ = false;
    std::vector<Leap> leaps_;
    Instant start_{0, 0, 1};  // of the period of a motion without flights
    Hints hints_;
    PhaseNotes notes_;                      // of the last period, or of the cycles followed
    bool keep_ = false;                     // whether those of a motion without a period are wanted
    std::optional<ConveyorMotion> walked_;  // the motion that answered instead
    double displacement_ = 0, derivative_ = 0;
    double v_ = 0, error_ = 0, slope_ = 0;  // of the last period: velocity at its start, Newton's step, f'
    std::vector<double> batches_;           // means of a motion without a period
    double longest_flight_ = 0;             // rad
    double cycles_followed_ = 0;            // in all batches
};

}  // namespace vibrotrough::theory::detail
