#pragma once

#include "theory/detail/rolling/normal.hpp"
#include "theory/detail/rolling/phase_sum.hpp"

#include <optional>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// A time, and what several relaxations with the same decays need of it.
struct Clock {
    double h;  ///< time since the start
    double sine, cosine;
    std::array<double, 2> decays;  ///< exp(-rate h) of each decay

    /// @param force  whose decays are meant
    static Clock at(double t, ContactForce const& force);
};

/// A velocity x that obeys x' = -rate x + (a contact force), in closed form from x(start) = first.
class Relaxation {
  public:
    /// @param force  its decays are counted from `start`
    Relaxation(double rate, ContactForce const& force, double first)
        : Relaxation(rate, force, first, Instant::at(force.start)) {}
    /// @param start  that of the force
    Relaxation(double rate, ContactForce const& force, double first, Instant const& start);

    /// x, x' and x'' at one time, and bounds to the right of it.
    struct At {
        double value, rate;
        double bend;  ///< bound of |x''|
        double jerk;  ///< bound of |x'''|
    };
    At at(double t) const { return at(Clock::at(t, force_)); }
    /// @param clock  made with a force that has the same start and decay rates
    At at(Clock const& clock) const;
    double operator()(double t) const;
    /// x as a sum whose first decay has the rate of x and the others those of the force; nothing when two
    /// rates are so close that their amplitudes would cancel.
    std::optional<PhaseSum> sum() const;
    /// The integral of x from the start to t.
    double travel(double t) const;

  private:
    double rate_;
    ContactForce force_;
    double mean_ = 0, sine_ = 0, cosine_ = 0, free_ = 0, wave_ = 0;
};

}  // namespace vibrotrough::theory::detail
