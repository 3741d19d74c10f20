#pragma once

#include "theory/conveyor.hpp"
#include "theory/detail/first_zero.hpp"
#include "theory/detail/trigonometric.hpp"

namespace vibrotrough::theory {

/// A velocity that obeys u' = -kappa u + constant + (a trigonometric sum), in closed form from u(t0) = u0.
class DrivenVelocity {
  public:
    /// @param particular  the bounded solution for the sum; nullptr if there is no sum
    /// @param integral    an antiderivative of `particular`
    DrivenVelocity(double kappa, double constant, detail::Trigonometric const* particular,
                   detail::Trigonometric const* integral, double t0, double u0);
    double operator()(double t) const;
    /// The distance travelled from t0 to t.
    double travel(double t) const;

  private:
    double kappa_, constant_, t0_, free_;
    detail::Trigonometric const* particular_;
    detail::Trigonometric const* integral_;
};

/// The analytic solution of each phase of a Conveyor. Lengths are in r cos(beta) along the trough and r
/// sin(beta) normal to it, time is in 1/omega, forces per unit mass are in omega^2 r cos(beta) and omega^2 r
/// sin(beta).
class ConveyorModel {
  public:
    explicit ConveyorModel(Conveyor const& conveyor);

    Conveyor const& conveyor() const { return conveyor_; }
    double trough_x(double t) const { return x_(t); }
    double trough_y(double t) const { return y_(t); }
    double trough_vx(double t) const { return vx_(t); }
    double trough_vy(double t) const { return vy_(t); }
    double trough_vx_bound() const { return vx_.bound(); }  ///< it is never faster
    double trough_ax(double t) const { return ax_(t); }
    double trough_ay(double t) const { return ay_(t); }

    double weight() const { return weight_; }    ///< 1 / Gamma
    double gravity() const { return gravity_; }  ///< tan(alpha) tan(beta) / Gamma
    double drag() const { return drag_; }
    double kinetic_tangent() const { return kinetic_; }  ///< mu tan(beta), side walls included
    double landing_tangent() const { return landing_; }  ///< the same for the impulse of a landing

    /// N(t) in contact: 1/Gamma + Y'' + kappa Y'.
    double normal_force(double t) const { return weight_ + normal_(t); }
    /// The friction force that keeps the mass at rest on the trough: X'' + kappa X' + gravity.
    double needed_friction(double t) const { return gravity_ + needed_(t); }
    /// The acceleration of a slide in direction sign (+1, -1) at zero slip speed; it starts if this is
    /// positive.
    double slide_drive(double sign, double t) const {
        Slide const& s = slide(sign);
        return s.drive_constant + s.drive(t);
    }
    /// The margin of static friction against a slide in direction sign; negative when the mass starts to
    /// slide.
    double hold(double sign, double t) const { return hold(sign).constant + hold(sign).sum(t); }

    DrivenVelocity slide_velocity(double sign, double t0, double u0) const;
    DrivenVelocity flight_velocity_x(double t0, double u0) const;
    DrivenVelocity flight_velocity_y(double t0, double w0) const;

    double take_off_after(double t, double end) const;
    double slip_after(double sign, double t, double end) const;
    double stop_after(double sign, double t, double speed, double end) const;
    double landing_after(double t, double gap, double gap_rate, double end) const;

  private:
    struct Shifted {
        double constant = 0;
        detail::Trigonometric sum;
    };
    struct Slide {
        double constant = 0;  // of u'
        detail::Trigonometric particular, integral;
        double drive_constant = 0;
        detail::Trigonometric drive;
        double drive_bound = 0, drive_rate_bound = 0, drive_bend = 0;
    };
    Slide const& slide(double sign) const { return sign > 0 ? positive_ : negative_; }
    Shifted const& hold(double sign) const { return sign > 0 ? hold_positive_ : hold_negative_; }
    Slide make_slide(double sign) const;

    Conveyor conveyor_;
    detail::Trigonometric x_, y_, vx_, vy_, ax_, ay_;
    double weight_, gravity_, drag_, kinetic_, static_, landing_;
    detail::Trigonometric normal_, needed_;
    Slide positive_, negative_;
    Shifted hold_positive_, hold_negative_;
    double normal_bend_, hold_bend_, fall_bound_;
};

}  // namespace vibrotrough::theory
