#pragma once

#include "theory/detail/phase_notes.hpp"
#include "theory/efficiency.hpp"

#include <optional>
#include <vector>

// Internal to this module.
namespace vibrotrough::theory::detail {

/// The efficiency of many conveyors, one after another; memory is reused, and so is what they share.
class ConveyorSolver {
  public:
    /// Whether a motion without a period is followed for its mean, which takes the longest; 0 is given
    /// otherwise.
    enum class Mean { wanted, left_out };

    /// Efficiency and mode. What was solved before does not change a bit of the answer.
    ///
    /// Without a period it is the mean over 20 batches, after 100 cycles. They have 16 cycles and 8 flights
    /// each at first, and twice as many until the half-width of the 95 % confidence interval is 0.01, at most
    /// 128.
    /// @param conveyor    its values are within their ranges
    /// @param start       the standard start, or another one
    /// @param after_zero  as in find_normal_orbit(); where the motion joins a known one, joined() says which,
    ///                    and the answer is empty
    /// @throws PhaseError when a phase cannot be solved
    Efficiency operator()(Conveyor const& conveyor, MotionStart const& start = {}, Mean mean = Mean::wanted,
                          std::vector<std::size_t> const* after_zero = nullptr);
    std::size_t joined() const { return orbit_.joined; }
    /// The flights of the motion that was solved last.
    NormalOrbit const& orbit() const { return orbit_; }
    Forces const& forces() const { return forces_; }
    /// The same answer with its phases.
    ConveyorMotion motion(Conveyor const& conveyor);

    /// What happened in a part of a motion without a period.
    struct Batch {
        double elapsed = 0;  ///< rad
        double moved = 0;    ///< r cos(beta)
        double gained = 0;   ///< of the slip velocity
        double mean() const { return moved / elapsed; }
    };

  private:
    enum class Search { found, runs_away };

    Tangent follow_period(double v);
    Tangent follow_from_start();
    void start_at_slide();
    bool is_carried_off(double v, double drift) const;
    bool is_fast(double v) const;
    double fastest() const;
    bool persists(double v, double drift) const;
    Search find_fixed_point(double from);
    Search iterate_from_start();
    void iterate_by_rule();
    void repeat_orbit(std::size_t times);
    Efficiency solve(Conveyor const& conveyor);
    std::optional<Efficiency> without_motion() const;
    Efficiency running_away() const;
    bool repeats() const;
    Efficiency average(std::size_t first);
    bool gets_ever_faster(Tangent const& s, std::vector<Batch> const& batches) const;
    Batch follow_cycles(Tangent& s, std::size_t& hop, int cycles);

    Forces forces_;
    NormalOrbit orbit_;
    bool orbit_known_ = false;
    MotionStart from_;
    Mean mean_ = Mean::wanted;
    std::vector<std::size_t> const* after_zero_ = nullptr;
    std::vector<Leap> leaps_;
    Instant start_{0, 0, 1};  // of the period of a motion without flights
    Hints hints_;
    PhaseNotes notes_;   // of the last period, or of the cycles followed
    bool keep_ = false;  // whether those of a motion without a period are wanted
    double displacement_ = 0, derivative_ = 0;
    double v_ = 0, error_ = 0, slope_ = 0;  // of the last period: velocity at its start, Newton's step, f'
    double cycles_followed_ = 0;            // in all batches
};

}  // namespace vibrotrough::theory::detail
