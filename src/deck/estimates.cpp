#include "deck/estimates.hpp"

#include "deck/deck_data.hpp"
#include "theory/inputs.hpp"
#include "theory/point_mass.hpp"

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

double bottom_load(scenario::Scenario const& s) {
    double const weight = s.layer.grains * mean_mass(s) * scenario::gravity * std::cos(s.trough.inclination);
    return weight * s.grains.diameter * s.grains.diameter / (s.layer.length * s.layer.width);
}

double overlap_under(scenario::Scenario const& s, double force) {
    return std::pow(0.75 * force / (effective_modulus(s) * std::sqrt(s.grains.diameter / 2)), 2.0 / 3);
}

double overlap_at_impact(scenario::Scenario const& s, double speed) {
    double const energy = mean_mass(s) * speed * speed / 2;
    return std::pow(15.0 / 8 * energy / (effective_modulus(s) * std::sqrt(s.grains.diameter / 2)), 0.4);
}

double impact_duration(scenario::Scenario const& s, double speed) {
    if (s.layer.block != scenario::Block::none) return 1 / (s.trough.frequency * s.solver.block_stiffness);
    double const modulus = effective_modulus(s), mass = mean_mass(s);
    return 2.87 * std::pow(mass * mass / (s.grains.diameter / 2 * modulus * modulus * speed), 0.2);
}

double flight_time(scenario::Scenario const& s) {
    if (throw_number(s.trough) <= 1) return 0;
    theory::Inputs inputs;
    inputs.set(theory::Input::machine_number, machine_number(s.trough));
    inputs.set(theory::Input::tan_vibration_angle, std::tan(s.trough.vibration_angle));
    inputs.set(theory::Input::tan_inclination, std::tan(s.trough.inclination));
    inputs.set(theory::Input::friction, s.trough.friction);
    return theory::solve(inputs.point()).flight_number / s.trough.frequency;
}

double steps_between_rebuilds(scenario::Scenario const& s, double speed) {
    return skin_in_diameters * s.grains.diameter / 2 / (speed * choose_time_step(s).time_step);
}

double expected_cycles(scenario::Scenario const& s) {
    constexpr double start_up = 12, scatter = 0.03, fewest = 20;
    double const measured = std::pow(2 * scatter / s.measure.half_width, 2);
    return std::min(start_up + std::max(fewest, measured), static_cast<double>(s.measure.max_cycles));
}

double expected_work(scenario::Scenario const& s) {
    DeckNumbers const numbers = make_numbers(s);
    double const spheres = numbers.clump ? static_cast<double>(numbers.clump->spheres.size()) : 1;
    double const settling =
        5 * std::sqrt(2 * numbers.fill_top / scenario::gravity) / numbers.settle_time_step;
    return s.measure.packings * spheres * s.layer.grains *
           (settling + expected_cycles(s) * numbers.time.steps_per_cycle);
}

double expected_bytes(scenario::Scenario const& s) {
    double const cycles = expected_cycles(s);
    return 120.0 * s.layer.grains * s.output.frames_per_cycle * cycles + 160 * cycles * s.measure.packings;
}

}  // namespace vibrotrough::deck
