#include "integrated_rolling_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

namespace vibrotrough::theory {
namespace {

using State = std::array<double, 5>;  // y, y', u, w, displacement relative to the trough

constexpr double one_cycle = 2 * std::numbers::pi;
constexpr int steps_per_cycle = 1500;
constexpr double zero = 1e-11;  // of velocities, after an event

int sign(double x) {
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// The equations of RollingLayer, with the discrete state that says which of them hold.
class Reference {
  public:
    explicit Reference(RollingLayer const& layer)
        : p_(layer.point),
          law_(layer.law),
          g_(p_.tan_inclination * p_.tan_vibration_angle / p_.throw_number) {}

    double mean_velocity(int cycles) {
        State x{-1 / (p_.throw_number * law_.stiffness * law_.stiffness), 0, 1, 0, 0};
        decide(0, x);
        double before = 0;
        for (int cycle = 0; cycle < cycles; ++cycle) {
            before = x[4];
            for (int i = 0; i < steps_per_cycle; ++i)
                advance(x, one_cycle * i / steps_per_cycle, one_cycle * (i + 1) / steps_per_cycle);
        }
        return (x[4] - before) / one_cycle;
    }

  private:
    double spring(State const& x) const {
        return -law_.stiffness * law_.stiffness * x[0] - 2 * law_.damping * law_.stiffness * x[1];
    }
    double limit(State const& x) const { return p_.friction * p_.tan_vibration_angle * spring(x); }
    double dry(State const& x) const { return law_.dry_torque * p_.tan_vibration_angle * spring(x); }
    double slip(State const& x, double t) const { return x[2] - std::cos(t) - x[3]; }

    /// The friction force in the present discrete state.
    double force(State const& x, double t) const {
        if (!touches_) return 0;
        if (slips_ != 0) return -slips_ * limit(x);
        if (turns_ == 0) return g_ - std::sin(t);
        double const inertia = law_.spin_inertia;
        return (-law_.torque * x[3] - turns_ * dry(x) + inertia * (g_ - std::sin(t))) / (1 + inertia);
    }
    void operator_rate(State const& x, State& rate, double t) const {
        double const f = force(x, t);
        rate[0] = x[1];
        rate[1] = std::sin(t) - 1 / p_.throw_number + (touches_ ? spring(x) : 0);
        rate[2] = f - g_;
        rate[3] = (-f - law_.torque * x[3] - (touches_ ? turns_ * dry(x) : 0)) / law_.spin_inertia;
        if (touches_ && turns_ == 0) rate[3] = 0;
        rate[4] = x[2] - std::cos(t);
    }
    State stepped(State x, double t, double dt) const {
        boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper;
        stepper.do_step([this](State const& s, State& rate, double at) { operator_rate(s, rate, at); }, x, t,
                        dt);
        return x;
    }
    bool over(State const& x, double t) const {
        if (!touches_) return x[0] < 0 && spring(x) > 0;
        if (spring(x) <= 0) return true;
        if (turns_ != 0 && turns_ * x[3] < 0) return true;
        if (slips_ != 0) return slips_ * slip(x, t) < 0;
        return std::abs(force(x, t)) > (turns_ == 0 ? std::min(limit(x), dry(x)) : limit(x));
    }
    void advance(State& x, double t, double end) {
        while (t < end) {
            State const whole = stepped(x, t, end - t);
            if (!over(whole, end)) {
                x = whole;
                return;
            }
            double low = 0, high = end - t;
            while (high - low > 1e-14) {
                double const middle = (low + high) / 2;
                (over(stepped(x, t, middle), t + middle) ? high : low) = middle;
            }
            x = stepped(x, t, high);
            t += high;
            decide(t, x);
        }
    }
    /// The discrete state that follows from the continuous one.
    void decide(double t, State& x) {
        touches_ = x[0] < 0 && spring(x) > 0;
        if (!touches_) {
            turns_ = slips_ = 0;
            return;
        }
        bool const stands = std::abs(x[3]) < zero, sticks = std::abs(slip(x, t)) < zero;
        bool const may_turn = p_.friction > law_.dry_torque;
        turns_ = stands ? 0 : sign(x[3]);
        slips_ = sticks ? 0 : sign(slip(x, t));
        if (stands) x[3] = 0;
        if (sticks) {
            x[2] = std::cos(t) + x[3];
            double needed = force(x, t);
            if (stands) {
                if (std::abs(needed) <= std::min(limit(x), dry(x))) return;
                if (may_turn) {
                    turns_ = -sign(needed);
                    needed = force(x, t);
                }
            }
            if (turns_ != 0 && std::abs(needed) <= limit(x)) return;
            slips_ = -sign(needed);
        }
        if (stands) turns_ = may_turn ? slips_ : 0;
    }

    PointMass p_;
    RollingLaw law_;
    double g_;
    bool touches_ = true;
    int slips_ = 0, turns_ = 0;
};

}  // namespace

double integrated_efficiency(RollingLayer const& layer, int cycles) {
    return Reference(layer).mean_velocity(cycles);
}

}  // namespace vibrotrough::theory
