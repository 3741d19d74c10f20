#pragma once

#include "theory/detail/forces.hpp"

#include <vector>

// The motion of a conveyor's mass normal to the trough, with rebounds, drag and harmonics. Internal to this
// module.
namespace vibrotrough::theory::detail {

/// A flight, and the contact that may follow it. Rates are relative to the trough, in omega r sin(beta).
struct Hop {
    Instant start, end;  ///< of the flight; it starts within [0, 2 pi)
    Instant leave;       ///< where the next flight starts: later than the landing when there is a contact
    double approach;     ///< rate at the landing, >= 0
    double rebound;      ///< rate with which the next flight starts, >= 0
    Decayed decayed;     ///< over its duration
};

/// The height of a mass that flies above the trough (Eqs. 12-14): g'' + kappa g' = -N.
class Ballistic {
  public:
    /// @param gap, rate  at the start; relative to the trough
    Ballistic(Forces const& forces, Instant const& start, double gap, double rate)
        : forces_(forces),
          start_(start.t),
          speed_(forces.vy()(start) + rate),
          level_(forces.y()(start) + gap) {}

    double gap(Instant const& at, Decayed const& d) const {
        return speed_ * d.once - forces_.weight() * d.twice - (forces_.y()(at) - level_);
    }
    double rate(Instant const& at, Decayed const& d) const {
        return speed_ * d.decay - forces_.weight() * d.once - forces_.vy()(at);
    }
    Decayed decayed(double t) const { return Decayed::after(forces_.drag(), t - start_); }
    /// How long it surely flies: the time up to which it is higher than the trough can be.
    double surely_above() const;

  private:
    Forces const& forces_;
    double start_, speed_, level_;  // absolute
};

/// How a small change of phase and rebound at one landing changes those at the next: a 2 x 2 matrix.
struct Sensitivity {
    double phase_phase = 1, phase_rate = 0, rate_phase = 0, rate_rate = 1;

    /// This change after an earlier one.
    Sensitivity after(Sensitivity const& earlier) const;
    double size() const;
};

/// How a motion begins: on the trough, with a rebound and a slip velocity. The default is the standard start.
struct MotionStart {
    Instant at{0, 0, 1};
    double rebound = 0;  ///< rate of the gap, upwards; 0: in contact, or taking off with the trough
    double v = 0;        ///< slip velocity
};

/// Finds the flights of a conveyor one after another, in the order in which they happen.
class FlightChain {
  public:
    /// Where the chain stands.
    struct Start {
        Instant at{0, 0, 1};
        double rate = 0;  ///< upwards, relative to the trough; 0 at a take-off from contact
        /// The number of the zero of the normal force at which the mass leaves the trough from contact; -1
        /// elsewhere.
        int zero = -1;
    };

    explicit FlightChain(Forces const& forces) : forces_(forces) {}

    /// Where the first flight starts; at infinity when the mass stays in contact.
    Start from(MotionStart const& start) const;
    /// The flight from there; `next` is set to where the flight after it starts, which may be at infinity.
    /// @throws PhaseError when it does not end
    Hop fly(Start const& start, Start& next) const;

    /// The sensitivity of the landing of a flight to its start.
    Sensitivity sensitivity(Hop const& hop, double start_rate) const;

  private:
    Start from_contact(Instant const& at) const;
    Hop flight(Start const& start) const;
    bool short_flight(Start const& start, Hop& hop) const;
    double lowest(Ballistic const& path, double low, double high) const;
    Hop landing(Start const& start, Ballistic const& path, double low, double high) const;

    Forces const& forces_;
};

}  // namespace vibrotrough::theory::detail
