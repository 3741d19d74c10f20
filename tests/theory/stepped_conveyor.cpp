#include "stepped_conveyor.hpp"

#include <cmath>
#include <numbers>

namespace vibrotrough::theory {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr int steps = 20000, settling_cycles = 80, measured_cycles = 44;

/// Velocity and acceleration of the trough, by definition.
struct Trough {
    Conveyor const& c;
    double velocity(double t, bool along) const {
        double v = along ? c.along_ratio * std::cos(t + c.along_phase) : std::cos(t);
        for (Harmonic const& h : along ? c.along : c.normal)
            v += h.amplitude / h.order * std::cos(h.order * t + h.phase);
        return v;
    }
    double acceleration(double t, bool along) const {
        double a = along ? -c.along_ratio * std::sin(t + c.along_phase) : -std::sin(t);
        for (Harmonic const& h : along ? c.along : c.normal)
            a -= h.amplitude * std::sin(h.order * t + h.phase);
        return a;
    }
};

}  // namespace

double steady_efficiency_by_steps(Conveyor const& c, FlightStart) {
    Trough const trough{c};
    PointMass const& p = c.point;
    double const wall = c.wall_pressure_ratio * c.wall_friction * c.height_over_width;
    double const kinetic = (p.friction + wall) * p.tan_vibration_angle;
    double const standing = (std::max(p.friction, c.static_friction) + wall) * p.tan_vibration_angle;
    double const weight = 1 / p.throw_number, pull = p.tan_inclination * p.tan_vibration_angle * weight;
    double const dt = two_pi / steps;
    double v = 0, gap = 0, rate = 0, travelled = 0;
    bool flying = false;
    for (int cycle = 0; cycle < settling_cycles + measured_cycles; ++cycle) {
        if (cycle == settling_cycles) travelled = 0;
        for (int i = 0; i < steps; ++i) {
            double const t = (i + 0.5) * dt, before = v;
            double const vx = trough.velocity(t, true), ax = trough.acceleration(t, true);
            double const force =
                weight + trough.acceleration(t, false) + c.air_drag * trough.velocity(t, false);
            if (!flying && force < 0) flying = true, gap = rate = 0;
            if (flying) {
                v += dt * (-pull - c.air_drag * (v + vx) - ax);
                double const old = rate;
                rate += dt * (-force - c.air_drag * rate);
                gap += dt * (rate + old) / 2;
                if (gap < 0) {
                    double const rebound = -c.restitution * rate > 1e-4 ? -c.restitution * rate : 0;
                    double const most = kinetic * (rebound - rate);
                    v = std::abs(v) <= most ? 0 : v - std::copysign(most, v);
                    gap = 0;
                    rate = rebound;
                    flying = rebound > 0;
                }
            } else {
                double const needed = ax + pull + c.air_drag * (v + vx);
                double const sign = v != 0 ? std::copysign(1.0, v) : (needed > standing * force ? -1.0 : 1.0);
                if (v != 0 || std::abs(needed) > standing * force) {
                    v += dt * (-needed - sign * kinetic * force);
                    if (v * sign < 0) v = 0;
                }
            }
            travelled += dt * (v + before) / 2;
        }
    }
    return travelled / (two_pi * measured_cycles);
}

}  // namespace vibrotrough::theory
