#include "prepare/time_grid.hpp"

#include "core/error.hpp"
#include "prepare/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::prepare {
namespace {

constexpr double fewest_steps = 500;   ///< per cycle
constexpr double harmonic_steps = 50;  ///< per period of the highest harmonic
constexpr double most_steps = 1e8;
constexpr double block_steps = 20;    ///< per contact, which is 2 per time constant of a landing
constexpr double block_damping = 10;  ///< damping in units of m / duration of the contact
constexpr double point_damping_ratio = 5, plate_damping_ratio = 1.5;

/// The smallest grains of one material.
struct SmallestGrains {
    scenario::Grains grains;
    double radius;       ///< m
    double restitution;  ///< the lowest of those on themselves and on all parts of the trough
    ContactPair pair;    ///< two of them
};

/// Those of each material. A clump has a radius of its own, that of its smallest sphere.
std::vector<SmallestGrains> smallest_grains(scenario::Scenario const& s, double smallest_radius) {
    std::vector<SmallestGrains> all;
    for (scenario::Material const& material : materials(s)) {
        scenario::Grains const& grains = material.grains;
        double const radius = s.materials.empty() ? smallest_radius : smallest_diameter(grains) / 2;
        double restitution = std::min(grains.restitution, material.trough_restitution);
        for (std::string const& part : own_parts(s))
            restitution = std::min(restitution, contact_with_trough(s, material, part).restitution);
        all.push_back({grains, radius, restitution, two_grains(grains, radius)});
    }
    return all;
}

double rayleigh_time(SmallestGrains const& smallest) {
    double const nu = smallest.grains.poisson_ratio;
    double const shear_modulus = smallest.grains.youngs_modulus.value() / (2 * (1 + nu));
    return std::numbers::pi * smallest.radius * std::sqrt(smallest.grains.density / shear_modulus) /
           (0.1631 * nu + 0.8766);
}

double rayleigh_time(scenario::Scenario const& s, double smallest_radius) {
    double shortest = std::numeric_limits<double>::infinity();
    for (SmallestGrains const& one : smallest_grains(s, smallest_radius))
        shortest = std::min(shortest, rayleigh_time(one));
    return shortest;
}

/// Duration of the shortest contact at this speed: of the smallest grains of each material, with themselves
/// and with those of the others. With R* and m* halved for two equal grains, R* and m* of two unequal ones
/// are the harmonic means of these.
double contact_time(scenario::Scenario const& s, double smallest_radius, double speed) {
    auto const all = smallest_grains(s, smallest_radius);
    auto const contact = contact_of(s, speed);
    double shortest = std::numeric_limits<double>::infinity();
    for (SmallestGrains const& one : all) {
        for (SmallestGrains const& other : all) {
            ContactPair const pair{scenario::harmonic_mean(one.pair.radius, other.pair.radius),
                                   scenario::harmonic_mean(one.pair.mass, other.pair.mass)};
            double const restitution = std::min(one.restitution, other.restitution);
            shortest = std::min(shortest, contact->duration(pair, speed, restitution));
        }
    }
    return shortest;
}

double block_duration(scenario::Scenario const& s) {
    return 1 / (s.trough.frequency * s.solver.block_stiffness);
}

}  // namespace

TimeGrid choose_time_step(scenario::Scenario const& s, StepLimits const& limits) {
    double const speed = 2 * limits.drive_speed;
    bool const block = s.layer.block != scenario::Block::none;
    double const contact = block ? block_duration(s) : contact_time(s, limits.smallest_radius, speed);
    double const rayleigh = rayleigh_time(s, limits.smallest_radius);
    double const period = 1 / s.trough.frequency;
    double longest = std::min(period / fewest_steps, period / (harmonic_steps * limits.highest_order));
    longest = block ? std::min(longest, contact / block_steps)
                    : std::min({longest, s.solver.rayleigh_fraction * rayleigh, 0.1 * contact});
    int const multiple = std::lcm(phases_per_cycle, std::max(1, s.output.frames_per_cycle));
    double const steps = std::ceil(period / longest / multiple) * multiple;
    if (steps > most_steps) {
        throw core::InputError(
            fmt::format("a cycle of {:.3g} s would take {:.3g} steps of {:.3g} s, more than {:.0g}; make the "
                        "grains larger or softer "
                        "(grains.diameter, grains.youngs_modulus) or the trough faster",
                        period, steps, period / steps, most_steps));
    }
    double const time_step = period / steps;
    return {time_step, static_cast<int>(steps), time_step / rayleigh, time_step / contact, speed};
}

TimeGrid with_steps(TimeGrid grid, int steps_per_cycle) {
    double const ratio = static_cast<double>(grid.steps_per_cycle) / steps_per_cycle;
    return {ratio * grid.time_step, steps_per_cycle, ratio * grid.rayleigh_fraction,
            ratio * grid.contact_fraction, grid.impact_speed};
}

double settling_speed(double fall_height, double gravity) {
    return std::sqrt(2 * gravity * fall_height);
}

double settling_time_step(scenario::Scenario const& s, StepLimits const& limits, double fall_height) {
    if (s.layer.block != scenario::Block::none) return block_duration(s) / block_steps;
    double const speed = settling_speed(fall_height, s.trough.gravity);
    return std::min(s.solver.rayleigh_fraction * rayleigh_time(s, limits.smallest_radius),
                    0.1 * contact_time(s, limits.smallest_radius, speed));
}

BlockContact block_contact(scenario::Scenario const& s, double mass, int spheres) {
    double const duration = block_duration(s);
    bool const plate = spheres > 1;
    double const ratio = plate ? plate_damping_ratio : point_damping_ratio;
    double const stiffness = mass * std::pow(block_damping / (2 * ratio * duration), 2);
    return {duration, stiffness / spheres, block_damping / duration / spheres, plate};
}

}  // namespace vibrotrough::prepare
