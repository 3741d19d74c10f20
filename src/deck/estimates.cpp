#include "deck/estimates.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::deck {
namespace {

double effective_modulus(scenario::Scenario const& s) {
    return s.grains.youngs_modulus / (2 * (1 - s.grains.poisson_ratio * s.grains.poisson_ratio));
}

double mean_mass(scenario::Scenario const& s) {
    return s.grains.density * mean_grain_volume(s.grains);
}

}  // namespace

double bottom_load(prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    return c.weight * s.grains.diameter * s.grains.diameter / (s.layer.length * s.layer.width);
}

double overlap_under(prepare::PreparedCase const& c, double force) {
    scenario::Scenario const& s = c.scenario;
    return std::pow(0.75 * force / (effective_modulus(s) * std::sqrt(s.grains.diameter / 2)), 2.0 / 3);
}

double overlap_at_impact(prepare::PreparedCase const& c, double speed) {
    scenario::Scenario const& s = c.scenario;
    double const energy = mean_mass(s) * speed * speed / 2;
    return std::pow(15.0 / 8 * energy / (effective_modulus(s) * std::sqrt(s.grains.diameter / 2)), 0.4);
}

double impact_duration(prepare::PreparedCase const& c, double speed) {
    scenario::Scenario const& s = c.scenario;
    if (s.layer.block != scenario::Block::none) return 1 / (s.trough.frequency * s.solver.block_stiffness);
    double const modulus = effective_modulus(s), mass = mean_mass(s);
    return 2.87 * std::pow(mass * mass / (s.grains.diameter / 2 * modulus * modulus * speed), 0.2);
}

double flight_time(prepare::PreparedCase const& c) {
    if (c.throw_number <= 1) return 0;
    return theory::solve(c.point_mass.conveyor.point).flight_number / c.scenario.trough.frequency;
}

double steps_between_rebuilds(prepare::PreparedCase const& c, double speed) {
    scenario::Scenario const& s = c.scenario;
    return skin_in_diameters * s.grains.diameter / 2 / (speed * c.time.time_step);
}

double expected_cycles(prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    constexpr double start_up = 12, scatter = 0.03, fewest = 20;
    double const measured = std::pow(2 * scatter / s.measure.half_width, 2);
    return std::min(start_up + std::max(fewest, measured), static_cast<double>(s.measure.max_cycles));
}

double expected_work(prepare::PreparedCase const& c) {
    double const settling = 5 * std::sqrt(2 * c.fill_top / scenario::gravity) / c.settle_time_step;
    return c.scenario.measure.packings *
           c.grain_steps(settling / c.time.steps_per_cycle + expected_cycles(c));
}

double expected_bytes(prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    double const cycles = expected_cycles(c);
    return 120.0 * s.layer.grains * s.output.frames_per_cycle * cycles + 160 * cycles * s.measure.packings;
}

}  // namespace vibrotrough::deck
