#include "measure/landing.hpp"

#include "measure/constants.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::measure {
namespace {

constexpr double landed = 0.01;  ///< of the approach: the landing is over
constexpr int most_periods = 1000;
constexpr double settled = 1e-9;  ///< of the velocity scale, change over a period

/// Slip against a trough of constant acceleration, with constant friction; exact.
struct Slip {
    double speed = 0, way = 0;

    /// @param drive     m/s^2, of the trough less gravity's: what the slip loses where nothing rubs
    /// @param friction  m/s^2, the most that friction gives
    void advance(double time, double drive, double friction) {
        while (time > 0) {
            double const direction = speed != 0 ? speed : -drive;
            if (speed == 0 && std::abs(drive) <= friction) return;
            double const rate = -drive - std::copysign(friction, direction);
            double const stop = speed * rate < 0 ? -speed / rate : time;
            double const step = std::min(stop, time);
            way += (speed + rate * step / 2) * step;
            speed = stop <= time && speed * rate < 0 ? 0 : speed + rate * step;
            time -= step;
        }
    }
};

/// One period of the mass under the layer's normal force.
void advance(Slip& slip, PhaseCurves const& curves, SlidingMass const& facts) {
    double const interval = 1 / (facts.frequency * PhaseSeries::per_cycle);
    double before = curves.trough_velocity_x.back();
    for (std::size_t i = 0; i < curves.trough_velocity_x.size(); ++i) {
        double const now = curves.trough_velocity_x[i];
        double const friction = facts.friction * std::max(curves.floor_force[i], 0.0) / facts.mass;
        slip.advance(interval, (now - before) / interval - facts.gravity_x, friction);
        before = now;
    }
}

}  // namespace

std::optional<double> landing_friction(LayerMotion const& motion) {
    PhaseCurves const& c = motion.curves;
    if (!motion.landing_phase || c.phase.empty()) return {};
    std::size_t const count = c.phase.size();
    auto const falling = [&c](std::size_t i) { return c.trough_velocity_z[i] - c.velocity_z[i]; };
    auto const begin = static_cast<std::size_t>(*motion.landing_phase / two_pi * PhaseSeries::per_cycle);
    double const approach = falling((begin + count - 1) % count);
    double along = 0, normal = 0;
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t const place = (begin + i) % count;
        along += c.tangential_force[place];
        normal += c.normal_force[place];
        if (falling(place) <= landed * approach) break;
    }
    if (!(normal > 0)) return {};
    return along / normal;
}

std::optional<double> efficiency_by_normal_force(PhaseCurves const& curves, SlidingMass const& facts) {
    if (curves.trough_velocity_x.empty()) return {};
    double const period = static_cast<double>(curves.trough_velocity_x.size()) / PhaseSeries::per_cycle;
    Slip slip;
    for (int i = 0; i < most_periods; ++i) {
        Slip const before = slip;
        advance(slip, curves, facts);
        if (std::abs(slip.speed - before.speed) < settled * facts.velocity_scale)
            return (slip.way - before.way) * facts.frequency / (period * facts.velocity_scale);
    }
    return {};
}

}  // namespace vibrotrough::measure
