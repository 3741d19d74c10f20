#include "prepare/time_grid.hpp"

#include "core/error.hpp"
#include "prepare/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

namespace vibrotrough::prepare {
namespace {

constexpr double fewest_steps = 500;   ///< per cycle
constexpr double harmonic_steps = 50;  ///< per period of the highest harmonic
constexpr double most_steps = 1e8;
constexpr double block_steps = 20;    ///< per contact, which is 2 per time constant of a landing
constexpr double block_damping = 10;  ///< damping in units of m / duration of the contact
constexpr double point_damping_ratio = 5, plate_damping_ratio = 1.5;

double rayleigh_time(scenario::Scenario const& s, double radius) {
    double const nu = s.grains.poisson_ratio;
    double const shear_modulus = s.grains.youngs_modulus.value() / (2 * (1 + nu));
    return std::numbers::pi * radius * std::sqrt(s.grains.density / shear_modulus) / (0.1631 * nu + 0.8766);
}

double hertz_time(scenario::Scenario const& s, double radius, double speed) {
    double const nu = s.grains.poisson_ratio;
    double const mass =
        s.grains.density * std::numbers::pi / 6 * std::pow(2 * radius, 3) / 2;     // m* of two equal grains
    double const modulus = s.grains.youngs_modulus.value() / (2 * (1 - nu * nu));  // E* of two equal grains
    return 2.87 * std::pow(mass * mass / (radius / 2 * modulus * modulus * speed), 0.2);
}

/// Duration of the shortest contact: of two of the smallest grains at this speed.
double contact_time(scenario::Scenario const& s, double radius, double speed) {
    if (s.engine.contact == scenario::ContactModel::hertz) return hertz_time(s, radius, speed);
    ContactPair const pair = two_grains(s.grains, radius);
    double const restitution = std::min(s.grains.restitution, s.trough.restitution);
    return linear_impact(hooke_stiffness(s.grains, pair, speed), pair.mass, damping_ratio(restitution))
        .duration;
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

double settling_speed(double fall_height) {
    return std::sqrt(2 * scenario::gravity * fall_height);
}

double settling_time_step(scenario::Scenario const& s, StepLimits const& limits, double fall_height) {
    if (s.layer.block != scenario::Block::none) return block_duration(s) / block_steps;
    double const speed = settling_speed(fall_height);
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
