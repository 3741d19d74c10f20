#include "measure/landing.hpp"

#include "theory/pushed_mass.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::measure {
namespace {

constexpr double landed = 0.01;  ///< of the approach: the landing is over

}  // namespace

std::optional<double> landing_friction(LayerMotion const& motion) {
    PhaseCurves const& c = motion.curves;
    if (!motion.landing_phase || c.phase.empty()) return {};
    std::size_t const count = c.phase.size();
    auto const falling = [&c](std::size_t i) { return c.trough_velocity_z[i] - c.velocity_z[i]; };
    std::size_t const begin = motion.landing_line;
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
    double const interval = 1 / (facts.frequency * PhaseSeries::per_cycle);
    double before = curves.trough_velocity_x.back();
    std::vector<theory::PushedInterval> period;
    for (std::size_t i = 0; i < curves.trough_velocity_x.size(); ++i) {
        double const now = curves.trough_velocity_x[i];
        period.push_back({(now - before) / interval - facts.gravity_x,
                          facts.friction * std::max(curves.floor_force[i], 0.0) / facts.mass});
        before = now;
    }
    auto const slip = theory::mean_slip(period, interval);
    return slip ? std::optional(*slip / facts.velocity_scale) : std::nullopt;
}

}  // namespace vibrotrough::measure
