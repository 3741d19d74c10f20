#pragma once

#include "theory/conveyor.hpp"
#include "theory/detail/wave.hpp"

#include <vector>

// Internal to this module.
namespace vibrotrough::theory::detail {

/// (1 - exp(-kappa h)) / kappa and its integral from 0 to h, beside exp(-kappa h): a velocity with
/// u' = -kappa u + c that begins as u0 is u0 decay + c once after h, and has travelled u0 once + c twice.
struct Decayed {
    double decay, once, twice;

    static Decayed after(double kappa, double h) {
        return kappa == 0 ? Decayed{1, h, h * h / 2} : with_drag(kappa, h);
    }

  private:
    static Decayed with_drag(double kappa, double h);
};

/// The forces on a mass that slides in one direction (Eq. 6): its speed w obeys w' = -kappa w + drive.
struct Sliding {
    double sign;
    Wave drive;             ///< acceleration at zero speed
    Wave response;          ///< the bounded w for the drive without its constant
    Wave path;              ///< an antiderivative of the response
    Crossings accelerates;  ///< of the drive
    Wave unheld;            ///< what static friction does not hold, if that is larger than kinetic friction
    Crossings own_starts;   ///< of it
    bool one_friction;      ///< static friction is not larger than kinetic friction

    /// Where this wave is positive, the slide starts from rest (Eqs. 7, 8).
    Crossings const& starts() const { return one_friction ? accelerates : own_starts; }
};

/// All forces on the mass and the motion of the trough, as waves whose zeros are known (Eqs. 5, 6, 22).
///
/// Lengths are in r cos(beta) along the trough and r sin(beta) normal to it, time is in 1/omega, forces per
/// unit mass are in omega^2 r cos(beta) and omega^2 r sin(beta). With the trough at X, Y:
/// - in contact N = 1/Gamma + Y'' + kappa Y', and a mass that rests needs the friction
///   X'' + kappa X' + tan(alpha) tan(beta) / Gamma;
/// - a slide has the friction -/+ mu tan(beta) N; in flight there is none;
/// - drag is -kappa times the velocity in space.
///
/// A force that is a function of time belongs to `normal_` or `needed_`, a constant one normal to the trough
/// to the weight in set() and, over gravity's, as a factor to steepest_held(), and nowhere else.
class Forces {
  public:
    /// Takes the place of the last conveyor, reusing its memory.
    void set(Conveyor const& conveyor);
    /// Becomes forces along the trough that do not change: what a mass that rests needs, and friction.
    void set_constant(double needed, double friction);

    Conveyor const& conveyor() const { return last_; }
    double drag() const { return last_.air_drag; }       ///< kappa
    double weight() const { return weight_; }            ///< constant part of N: 1 / Gamma
    double gravity() const { return gravity_; }          ///< tan(alpha) tan(beta) / Gamma
    double kinetic_tangent() const { return kinetic_; }  ///< mu tan(beta), side walls included
    double landing_tangent() const { return landing_; }  ///< the same for the impulse of a landing
    double restitution() const { return last_.restitution; }
    double slowest_rebound() const { return last_.slowest_rebound; }
    bool one_friction() const { return positive_.one_friction; }
    /// tan(alpha) of the steepest trough on which friction can hold the mass over a cycle.
    /// @param lands  whether there are landings
    double steepest_held(bool lands) const;
    /// Whether flights start by the rule of Table 1, FlightStart::trough_velocity_rule.
    bool starts_by_rule() const { return last_.flight_start == FlightStart::trough_velocity_rule; }
    /// Whether the normal motion is that of the conveyor before.
    bool same_normal() const { return same_normal_; }

    Wave const& x() const { return x_; }    ///< position of the trough along x
    Wave const& vx() const { return vx_; }  ///< its rate
    Wave const& y() const { return y_; }    ///< height of the trough
    Wave const& vy() const { return vy_; }
    Wave const& normal_force() const { return normal_; }     ///< N in contact
    Wave const& needed_friction() const { return needed_; }  ///< of a mass that rests
    Crossings const& presses() const { return presses_; }    ///< of the normal force in contact
    Sliding const& slide(double sign) const { return sign > 0 ? positive_ : negative_; }

  private:
    void set_trough(Conveyor const& conveyor);
    void set_slide(Sliding& slide, double sign, double rest);

    Conveyor last_{};
    bool known_ = false, same_normal_ = false;
    double weight_ = 0, gravity_ = 0, kinetic_ = 0, landing_ = 0;
    Wave x_, vx_, y_, vy_, normal_, needed_;
    Crossings presses_;
    Sliding positive_{}, negative_{};
};

}  // namespace vibrotrough::theory::detail
