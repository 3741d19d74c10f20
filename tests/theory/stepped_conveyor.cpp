#include "stepped_conveyor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace vibrotrough::theory {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr int steps = 3000;  // per cycle

/// Slip velocity, gap and its rate.
using State = std::array<double, 4>;  // the fourth is the slip distance

/// The equations of motion, integrated by the fourth-order Runge-Kutta method; events are found by bisecting
/// the step in which they occur.
class Stepper {
  public:
    explicit Stepper(Conveyor const& conveyor) : c_(conveyor) {
        PointMass const& p = c_.point;
        double const wall = c_.wall_pressure_ratio * c_.wall_friction * c_.height_over_width;
        kinetic_ = (p.friction + wall) * p.tan_vibration_angle;
        standing_ = (std::max(p.friction, c_.static_friction) + wall) * p.tan_vibration_angle;
        landing_ = (c_.landing_friction.value_or(p.friction) + wall) * p.tan_vibration_angle;
        weight_ = 1 / p.throw_number;
        pull_ = p.tan_inclination * p.tan_vibration_angle / p.throw_number;
        enter_contact();
    }
    void cycle() {
        double const begin = t_;
        for (int i = 0; i < steps; ++i) advance(begin + two_pi * (i + 1) / steps);
        t_ -= two_pi;
    }
    State const& state() const { return s_; }

  private:
    enum class Phase { stick, forward, backward, flight };

    double velocity(double t, bool along) const {
        double v = along ? c_.along_ratio * std::cos(t + c_.along_phase) : std::cos(t);
        for (Harmonic const& h : along ? c_.along : c_.normal)
            v += h.amplitude / h.order * std::cos(h.order * t + h.phase);
        return v;
    }
    double acceleration(double t, bool along) const {
        double a = along ? -c_.along_ratio * std::sin(t + c_.along_phase) : -std::sin(t);
        for (Harmonic const& h : along ? c_.along : c_.normal)
            a -= h.amplitude * std::sin(h.order * t + h.phase);
        return a;
    }
    double force(double t) const {
        return weight_ + acceleration(t, false) + c_.air_drag * velocity(t, false);
    }
    double needed(double t) const { return acceleration(t, true) + pull_ + c_.air_drag * velocity(t, true); }

    State rates(double t, State const& s) const {
        if (phase_ == Phase::stick) return {0, 0, 0, 0};
        double const drag = c_.air_drag;
        if (phase_ == Phase::flight) return {-needed(t) - drag * s[0], s[2], -force(t) - drag * s[2], s[0]};
        double const sign = phase_ == Phase::forward ? 1 : -1;
        return {-needed(t) - sign * kinetic_ * force(t) - drag * s[0], 0, 0, s[0]};
    }
    State stepped(double h) const {
        auto const along = [&](State const& rate, double part) {
            State s = s_;
            for (std::size_t i = 0; i < s.size(); ++i) s[i] += part * rate[i];
            return s;
        };
        State const a = rates(t_, s_), b = rates(t_ + h / 2, along(a, h / 2));
        State const c = rates(t_ + h / 2, along(b, h / 2)), d = rates(t_ + h, along(c, h));
        State s = s_;
        for (std::size_t i = 0; i < s.size(); ++i) s[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        return s;
    }
    /// Whether the phase still lasts at the end of a step of length h.
    bool holds(double h) const {
        State const s = stepped(h);
        double const t = t_ + h;
        if (phase_ == Phase::flight) return s[1] >= 0;
        if (force(t) < 0) return false;
        if (phase_ == Phase::stick) return std::abs(needed(t)) <= standing_ * force(t);
        return phase_ == Phase::forward ? s[0] >= 0 : s[0] <= 0;
    }
    void advance(double end) {
        for (int guard = 0; guard < 200 && end - t_ > 1e-14; ++guard) {
            double h = end - t_;
            bool const event = !holds(h);
            if (event) {
                double lo = 0;
                for (int i = 0; i < 60; ++i) {
                    double const middle = (lo + h) / 2;
                    (holds(middle) ? lo : h) = middle;
                }
            }
            s_ = stepped(h);
            t_ += h;
            if (event) change();
        }
    }
    void change() {
        if (phase_ == Phase::flight) {
            double const approach = -s_[2];
            double const bounce = c_.restitution * approach,
                         rebound = bounce > c_.slowest_rebound ? bounce : 0;
            double const most = landing_ * (approach + rebound);
            s_[0] = std::abs(s_[0]) <= most ? 0 : s_[0] - std::copysign(most, s_[0]);
            s_[1] = 0;
            s_[2] = rebound;
            if (rebound > 0) return;
        } else if (force(t_) > 0 && phase_ != Phase::stick) {
            s_[0] = 0;
        }
        enter_contact();
    }
    void enter_contact() {
        if (force(t_) <= 0) {
            phase_ = Phase::flight;
        } else if (s_[0] != 0) {
            phase_ = s_[0] > 0 ? Phase::forward : Phase::backward;
        } else if (std::abs(needed(t_)) > standing_ * force(t_)) {
            phase_ = needed(t_) > 0 ? Phase::backward : Phase::forward;
        } else {
            phase_ = Phase::stick;
        }
    }

    Conveyor c_;
    double kinetic_, standing_, landing_, weight_, pull_;
    Phase phase_ = Phase::stick;
    double t_ = 0;
    State s_{};
};

}  // namespace

double steady_efficiency_by_steps(Conveyor const& conveyor, int period_cycles) {
    Stepper stepper(conveyor);
    double mean = 0;
    for (int period = 0; period < 400; ++period) {
        double const before = stepper.state()[3];
        for (int i = 0; i < period_cycles; ++i) stepper.cycle();
        double const now = (stepper.state()[3] - before) / (two_pi * period_cycles);
        if (period > 3 && std::abs(now - mean) < 1e-11) return now;
        mean = now;
    }
    return mean;
}

}  // namespace vibrotrough::theory
