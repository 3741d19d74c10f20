#pragma once

#include "theory/conveyor.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace vibrotrough::theory {

/// amplitude sin(order t + phase)
struct Term {
    double order, amplitude, phase;
};

/// A sum of such terms, each evaluated at t in rad.
class Trigonometric {
  public:
    Trigonometric() = default;
    explicit Trigonometric(std::vector<Term> terms) : terms_(std::move(terms)) {}

    double operator()(double t) const {
        double sum = 0;
        for (Term const& term : terms_) sum += term.amplitude * std::sin(term.order * t + term.phase);
        return sum;
    }
    double rate(double t) const {
        double sum = 0;
        for (Term const& term : terms_)
            sum += term.amplitude * term.order * std::cos(term.order * t + term.phase);
        return sum;
    }
    /// An upper bound of |value|.
    double bound() const { return derivative_bound(0); }
    /// An upper bound of |n-th derivative|.
    double derivative_bound(int n) const {
        double sum = 0;
        for (Term const& term : terms_) sum += std::abs(term.amplitude) * std::pow(term.order, n);
        return sum;
    }
    /// The linear combination second (d/dt)^2 + first d/dt applied to the sum.
    Trigonometric differentiated(double second, double first) const;
    /// The bounded solution u of u' = -kappa u + (this sum).
    Trigonometric driven(double kappa) const;
    /// An antiderivative.
    Trigonometric integrated() const;
    Trigonometric operator*(double factor) const;
    Trigonometric operator+(Trigonometric const& other) const;

  private:
    std::vector<Term> terms_;
};

/// The position of the trough along or normal to itself.
Trigonometric trough(double ratio, double phase, std::vector<Harmonic> const& harmonics);

/// A velocity that obeys u' = -kappa u + constant + (a trigonometric sum), in closed form from u(t0) = u0.
class DrivenVelocity {
  public:
    /// @param particular  the bounded solution for the sum; nullptr if there is no sum
    /// @param integral    an antiderivative of `particular`
    DrivenVelocity(double kappa, double constant, Trigonometric const* particular,
                   Trigonometric const* integral, double t0, double u0);
    double operator()(double t) const;
    /// The distance travelled from t0 to t.
    double travel(double t) const;

  private:
    double kappa_, constant_, t0_, free_;
    Trigonometric const* particular_;
    Trigonometric const* integral_;
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
    double trough_ax(double t) const { return ax_(t); }
    double trough_ay(double t) const { return ay_(t); }

    double weight() const { return weight_; }    ///< 1 / Gamma
    double gravity() const { return gravity_; }  ///< tan(alpha) tan(beta) / Gamma
    double drag() const { return drag_; }
    double kinetic_tangent() const { return kinetic_; }  ///< mu tan(beta), side walls included

    /// N(t) in contact: 1/Gamma + Y'' + kappa Y'.
    double normal_force(double t) const { return weight_ + normal_(t); }
    /// The friction force that keeps the mass at rest on the trough: X'' + kappa X' + gravity.
    double needed_friction(double t) const { return gravity_ + needed_(t); }

    DrivenVelocity slide_velocity(double sign, double t0, double u0) const;
    DrivenVelocity flight_velocity_x(double t0, double u0) const;
    DrivenVelocity flight_velocity_y(double t0, double w0) const;

  private:
    struct Slide {
        double constant = 0;  // of u'
        Trigonometric particular, integral;
    };
    Slide const& slide(double sign) const { return sign > 0 ? positive_ : negative_; }
    Slide make_slide(double sign) const;

    Conveyor conveyor_;
    Trigonometric x_, y_, vx_, vy_, ax_, ay_;
    double weight_, gravity_, drag_, kinetic_;
    Trigonometric normal_, needed_;
    Slide positive_, negative_;
};

}  // namespace vibrotrough::theory
