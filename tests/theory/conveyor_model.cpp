#include "conveyor_model.hpp"

#include <numbers>

namespace vibrotrough::theory {
namespace {

constexpr double quarter = std::numbers::pi / 2;

/// p sin(x) + q cos(x) as one sine.
Term combined(double order, double p, double q, double phase) {
    if (q == 0) return {order, p, phase};
    return {order, std::hypot(p, q), phase + std::atan2(q, p)};
}

/// (1 - exp(-kappa h)) / kappa
double once_decayed(double kappa, double h) {
    return kappa * h == 0 ? h : -std::expm1(-kappa * h) / kappa;
}

/// The integral of once_decayed: (h - once_decayed) / kappa, from a series where the difference would lose
/// digits.
double twice_decayed(double kappa, double h) {
    double const x = kappa * h;
    if (x > 0.1) return (h - once_decayed(kappa, h)) / kappa;
    double sum = 0, term = h * h / 2;
    for (int n = 3; n < 16; ++n) {
        sum += term;
        term *= -x / n;
    }
    return sum;
}

}  // namespace

/// The position of the trough; an acceleration -amplitude sin(order t + phase) gives amplitude / order^2
/// sin(...).
Trigonometric trough(double ratio, double phase, std::vector<Harmonic> const& harmonics) {
    std::vector<Term> terms{{1, ratio, phase}};
    for (Harmonic const& h : harmonics) {
        terms.push_back({static_cast<double>(h.order), h.amplitude / h.order / h.order, h.phase});
    }
    return Trigonometric(std::move(terms));
}

Trigonometric Trigonometric::differentiated(double second, double first) const {
    std::vector<Term> terms;
    for (Term const& t : terms_) {
        terms.push_back(combined(t.order, -second * t.order * t.order * t.amplitude,
                                 first * t.order * t.amplitude, t.phase));
    }
    return Trigonometric(std::move(terms));
}

Trigonometric Trigonometric::driven(double kappa) const {
    std::vector<Term> terms;
    for (Term const& t : terms_) {
        double const size = kappa * kappa + t.order * t.order;
        terms.push_back(
            combined(t.order, kappa * t.amplitude / size, -t.order * t.amplitude / size, t.phase));
    }
    return Trigonometric(std::move(terms));
}

Trigonometric Trigonometric::integrated() const {
    std::vector<Term> terms;
    for (Term const& t : terms_) terms.push_back({t.order, t.amplitude / t.order, t.phase - quarter});
    return Trigonometric(std::move(terms));
}

Trigonometric Trigonometric::operator*(double factor) const {
    std::vector<Term> terms = terms_;
    for (Term& t : terms) t.amplitude *= factor;
    return Trigonometric(std::move(terms));
}

Trigonometric Trigonometric::operator+(Trigonometric const& other) const {
    std::vector<Term> terms = terms_;
    terms.insert(terms.end(), other.terms_.begin(), other.terms_.end());
    return Trigonometric(std::move(terms));
}

DrivenVelocity::DrivenVelocity(double kappa, double constant, Trigonometric const* particular,
                               Trigonometric const* integral, double t0, double u0)
    : kappa_(kappa),
      constant_(constant),
      t0_(t0),
      free_(u0 - (particular != nullptr ? (*particular)(t0) : 0)),
      particular_(particular),
      integral_(integral) {}

double DrivenVelocity::operator()(double t) const {
    double const h = t - t0_;
    double const driven = particular_ != nullptr ? (*particular_)(t) : 0;
    return driven + free_ * std::exp(-kappa_ * h) + constant_ * once_decayed(kappa_, h);
}

double DrivenVelocity::travel(double t) const {
    double const h = t - t0_;
    double const driven = integral_ != nullptr ? (*integral_)(t) - (*integral_)(t0_) : 0;
    return driven + free_ * once_decayed(kappa_, h) + constant_ * twice_decayed(kappa_, h);
}

ConveyorModel::ConveyorModel(Conveyor const& conveyor)
    : conveyor_(conveyor),
      x_(trough(conveyor.along_ratio, conveyor.along_phase, conveyor.along)),
      y_(trough(1, 0, conveyor.normal)),
      vx_(x_.differentiated(0, 1)),
      vy_(y_.differentiated(0, 1)),
      ax_(x_.differentiated(1, 0)),
      ay_(y_.differentiated(1, 0)),
      weight_(1 / conveyor.point.throw_number),
      gravity_(conveyor.point.tan_inclination * conveyor.point.tan_vibration_angle * weight_),
      drag_(conveyor.air_drag) {
    kinetic_ = effective_friction(conveyor).kinetic_friction * conveyor.point.tan_vibration_angle;
    normal_ = y_.differentiated(1, drag_);
    needed_ = x_.differentiated(1, drag_);
    positive_ = make_slide(+1);
    negative_ = make_slide(-1);
}

// u' = -kappa u - gravity - sign mu tan(beta) N.
ConveyorModel::Slide ConveyorModel::make_slide(double sign) const {
    Slide s;
    s.constant = -gravity_ - sign * kinetic_ * weight_;
    s.particular = (normal_ * (-sign * kinetic_)).driven(drag_);
    s.integral = s.particular.integrated();
    return s;
}

DrivenVelocity ConveyorModel::slide_velocity(double sign, double t0, double u0) const {
    Slide const& s = slide(sign);
    return {drag_, s.constant, &s.particular, &s.integral, t0, u0};
}

DrivenVelocity ConveyorModel::flight_velocity_x(double t0, double u0) const {
    return {drag_, -gravity_, nullptr, nullptr, t0, u0};
}

DrivenVelocity ConveyorModel::flight_velocity_y(double t0, double w0) const {
    return {drag_, -weight_, nullptr, nullptr, t0, w0};
}

}  // namespace vibrotrough::theory
