#pragma once

#include "theory/conveyor.hpp"
#include "theory/efficiency.hpp"

#include <memory>
#include <vector>

namespace vibrotrough::theory {

/// One of the long-term motions of a conveyor.
struct CoexistingMotion {
    Efficiency motion;  ///< its efficiency, mode and period
    double share;       ///< of the starts that lead to it, in [0, 1]
};

/// So many starts are followed for a single motion: one that 5 % of all starts lead to is missed once in 25
/// times.
inline constexpr int usual_starts = 64;

/// Finds the long-term motions to which different starts lead, for many conveyors one after another. With
/// rebounds, or with a larger static friction, there can be several. Use one survey per thread.
///
/// The standard start is at rest on the trough at t = 0; the velocity efficiency of all commands is that of
/// the motion that develops from it. The other starts are on the trough, too, at a time t of the cycle, with
/// a rebound of up to 2 e / (1 - e) times the largest normal velocity of the trough (the mass cannot rebound
/// faster for ever), and with a slip velocity of up to twice the largest velocity of the trough along itself,
/// in both directions. Start number k has the three coordinates frac(0.5 + k a), with a = 1/p, 1/p^2, 1/p^3
/// and p^4 = p + 1: they fill the space evenly, and more starts contain fewer.
///
/// Motions with a period are the same if their efficiencies agree to 1e-6 (1 + |eta|), which is more than the
/// error of a motion that is accepted while it still settles, and if one period is a multiple of the other.
/// All motions without a period count as one.
class MotionSurvey {
  public:
    MotionSurvey();
    ~MotionSurvey();
    /// Moves the memory.
    MotionSurvey(MotionSurvey&&) noexcept;
    /// Moves the memory.
    MotionSurvey& operator=(MotionSurvey&&) noexcept;

    /// The motion from the standard start first, then the others, the one with most starts first. Starts
    /// whose motion cannot be solved do not count.
    /// @param standard  the answer of EfficiencySolver
    /// @param starts    >= 1, the standard start included
    /// @throws std::invalid_argument when an input is out of range
    std::vector<CoexistingMotion> operator()(Conveyor const& conveyor, Efficiency const& standard,
                                             int starts = usual_starts);

  private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

/// The efficiency of a motion with its phases.
Efficiency efficiency_of(ConveyorMotion const& motion);

}  // namespace vibrotrough::theory
