#pragma once

#include "theory/conveyor.hpp"
#include "theory/detail/conveyor/wave.hpp"

#include <vector>

// Internal to this room.
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

/// A slide in one direction: its speed w obeys w' = -kappa w + drive.
struct Sliding {
    double sign;
    Wave drive;             ///< acceleration at zero speed
    Wave response;          ///< the bounded w for the drive without its constant
    Wave path;              ///< an antiderivative of the response
    Crossings accelerates;  ///< of the drive
    Crossings own_starts;   ///< of minus the margin of static friction, if that differs from the drive
    bool one_friction;      ///< static friction is not larger than kinetic friction

    /// Where this wave is positive, the slide starts from rest.
    Crossings const& starts() const { return one_friction ? accelerates : own_starts; }
};

/// The forces and motions of a conveyor as waves whose zeros are known. Units are those of ConveyorModel.
class ConveyorWaves {
  public:
    /// Takes the place of the last conveyor, reusing its memory.
    void set(Conveyor const& conveyor);

    double drag() const { return drag_; }
    double weight() const { return weight_; }            ///< 1 / Gamma
    double gravity() const { return gravity_; }          ///< tan(alpha) tan(beta) / Gamma
    double kinetic_tangent() const { return kinetic_; }  ///< mu tan(beta), side walls included
    double landing_tangent() const { return landing_; }  ///< the same for the impulse of a landing
    double restitution() const { return restitution_; }
    double slowest_rebound() const { return slowest_rebound_; }
    bool one_friction() const { return positive_.one_friction; }
    /// Whether flights start by the rule of Table 1, FlightStart::trough_velocity_rule.
    bool starts_by_rule() const { return last_.flight_start == FlightStart::trough_velocity_rule; }
    /// Whether the normal motion is that of the conveyor before.
    bool same_normal() const { return same_normal_; }

    Wave const& x() const { return x_; }    ///< position of the trough along x
    Wave const& vx() const { return vx_; }  ///< its rate
    Wave const& y() const { return y_; }    ///< height of the trough
    Wave const& vy() const { return vy_; }
    Wave const& normal_force() const { return normal_; }
    Crossings const& presses() const { return presses_; }  ///< of the normal force in contact
    Sliding const& slide(double sign) const { return sign > 0 ? positive_ : negative_; }

  private:
    /// The part of X and Y of one order: coefficients of sine and cosine.
    struct Part {
        int order;
        double x_sine, x_cosine, y_sine, y_cosine;
    };
    void collect(Conveyor const& conveyor);
    Part& part(int order);
    void set_normal();
    void set_slide(Sliding& slide, double sign, double rest);

    std::vector<Part> parts_;
    Conveyor last_{};
    bool known_ = false, same_normal_ = false;
    double drag_ = 0, weight_ = 0, gravity_ = 0, kinetic_ = 0, landing_ = 0, restitution_ = 0,
           slowest_rebound_ = 0;
    Wave x_, vx_, y_, vy_, normal_, needed_, hold_;
    Crossings presses_;
    Sliding positive_{}, negative_{};
};

}  // namespace vibrotrough::theory::detail
