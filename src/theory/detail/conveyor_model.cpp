#include "theory/detail/conveyor_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vibrotrough::theory {
namespace {

using detail::first_zero;
using detail::Sample;
using detail::Term;
using detail::Trigonometric;

constexpr double drag_reach = 1;  // rad: the distance within which the bounds on drag below hold

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

/// The position of the trough; an acceleration -amplitude sin(order t + phase) gives amplitude / order^2
/// sin(...).
Trigonometric trough(double ratio, double phase, std::vector<Harmonic> const& harmonics) {
    std::vector<Term> terms{{1, ratio, phase}};
    for (Harmonic const& h : harmonics) {
        terms.push_back({static_cast<double>(h.order), h.amplitude / h.order / h.order, h.phase});
    }
    return Trigonometric(std::move(terms));
}

}  // namespace

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
    auto const friction = effective_friction(conveyor);
    kinetic_ = friction.kinetic_friction * conveyor.point.tan_vibration_angle;
    static_ = friction.static_friction * conveyor.point.tan_vibration_angle;
    landing_ = friction.landing_friction * conveyor.point.tan_vibration_angle;
    normal_ = y_.differentiated(1, drag_);
    needed_ = x_.differentiated(1, drag_);
    positive_ = make_slide(+1);
    negative_ = make_slide(-1);
    // The mass lags behind (N slide) when a friction force above +mu_s N is needed, and runs ahead (P slide)
    // when it is below -mu_s N.
    hold_positive_ = {static_ * weight_ + gravity_, normal_ * static_ + needed_};
    hold_negative_ = {static_ * weight_ - gravity_, normal_ * static_ + needed_ * -1};
    normal_bend_ = normal_.derivative_bound(2);
    hold_bend_ = static_ * normal_bend_ + needed_.derivative_bound(2);
    fall_bound_ = weight_ + ay_.bound();
}

// u' = -kappa u - gravity - sign mu tan(beta) N; with u = X' + v the speed w = sign v obeys w' = -kappa w +
// drive.
ConveyorModel::Slide ConveyorModel::make_slide(double sign) const {
    Slide s;
    s.constant = -gravity_ - sign * kinetic_ * weight_;
    s.particular = (normal_ * (-sign * kinetic_)).driven(drag_);
    s.integral = s.particular.integrated();
    s.drive_constant = -sign * gravity_ - kinetic_ * weight_;
    s.drive = needed_ * -sign + normal_ * -kinetic_;
    s.drive_bound = std::abs(s.drive_constant) + s.drive.bound();
    s.drive_rate_bound = s.drive.derivative_bound(1);
    s.drive_bend = s.drive.derivative_bound(2);
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

double ConveyorModel::take_off_after(double t, double end) const {
    auto const force = [&](double s) { return Sample{normal_force(s), normal_.rate(s), normal_bend_}; };
    return first_zero(force, t, end);
}

double ConveyorModel::slip_after(double sign, double t, double end) const {
    auto const& h = hold(sign);
    auto const held = [&](double s) { return Sample{h.constant + h.sum(s), h.sum.rate(s), hold_bend_}; };
    return first_zero(held, t, end);
}

double ConveyorModel::stop_after(double sign, double t, double speed, double end) const {
    Slide const& s = slide(sign);
    // While the driving acceleration is positive, the speed is positive, too.
    auto const drive = [&](double a) { return Sample{slide_drive(sign, a), s.drive.rate(a), s.drive_bend}; };
    double const from = speed == 0 || slide_drive(sign, t) >= 0 ? first_zero(drive, t, end) : t;
    if (from >= end) return end;
    DrivenVelocity const u = slide_velocity(sign, t, trough_vx(t) + sign * speed);
    auto const slip = [&](double a) {
        double const w = sign * (u(a) - trough_vx(a));
        double const most = std::abs(w) + s.drive_bound * drag_reach;
        return Sample{w, slide_drive(sign, a) - drag_ * w,
                      s.drive_rate_bound + drag_ * (s.drive_bound + drag_ * most),
                      drag_ > 0 ? drag_reach : HUGE_VAL};
    };
    return first_zero(slip, from, end);
}

double ConveyorModel::landing_after(double t, double gap, double gap_rate, double end) const {
    double from = t;
    bool const takes_off = gap == 0 && gap_rate == 0;
    if (takes_off || (gap_rate >= 0 && normal_force(t) <= 0)) {
        // While the trough falls away faster than the mass, the gap grows: (gap)'' + kappa (gap)' = -N.
        auto const lift = [&](double s) { return Sample{-normal_force(s), -normal_.rate(s), normal_bend_}; };
        from = first_zero(lift, t, end);
        if (from >= end) return end;
    }
    DrivenVelocity const w = flight_velocity_y(t, trough_vy(t) + gap_rate);
    double const level = trough_y(t) + gap;
    auto const height = [&](double s) {
        double const rate = w(s);
        double const bend = fall_bound_ + drag_ * (std::abs(rate) + weight_ * drag_reach);
        return Sample{level + w.travel(s) - trough_y(s), rate - trough_vy(s), bend,
                      drag_ > 0 ? drag_reach : HUGE_VAL};
    };
    return first_zero(height, from, end);
}

}  // namespace vibrotrough::theory
