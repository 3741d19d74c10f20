#include "learn/exciter.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

constexpr double near_resonance = 0.2;  // of its frequency

double squared_omega(double frequency) {
    double const omega = 2 * std::numbers::pi * frequency;
    return omega * omega;
}

/// kg, what acts like a mass: inertia less the springs; below the resonance less than 0.
double mass_on_springs(MovedMachine const& machine, double frequency, double material) {
    double const resonance = resonance_of(machine, material);
    if (resonance > 0 && std::abs(frequency / resonance - 1) < near_resonance)
        throw std::invalid_argument(fmt::format(
            "the drive at {:.4g} 1/min is too near to the resonance of the springs at {:.4g} "
            "1/min: the stroke depends on the damping of springs and motors there, which is not known",
            60 * frequency, 60 * resonance));
    return machine.moving_mass(material) - machine.spring / squared_omega(frequency);
}

/// Damping over the material's mass times omega; none where it is not known.
Uncertain damping_of(MovedMachine const& machine) {
    return machine.damping.value_or(Uncertain{0});
}

/// kg, the force over the acceleration: |m - k / omega^2 - i c / omega|.
double effective_mass(MovedMachine const& machine, double frequency, double material) {
    return std::hypot(mass_on_springs(machine, frequency, material), damping_of(machine).mean * material);
}

}  // namespace

Exciter exciter_of_force(double force, double frequency) {
    return {force / squared_omega(frequency)};
}

double force_of(Exciter const& exciter, double frequency) {
    return exciter.static_moment * squared_omega(frequency);
}

double resonance_of(MovedMachine const& machine, double material) {
    return std::sqrt(machine.spring / machine.moving_mass(material)) / (2 * std::numbers::pi);
}

double amplitude_of(MovedMachine const& machine, double frequency, double material) {
    if (!machine.exciter) throw std::invalid_argument("the machine has no exciter");
    return machine.exciter->static_moment / effective_mass(machine, frequency, material);
}

double amplitude_sd(MovedMachine const& machine, double frequency, double material) {
    double const amplitude = amplitude_of(machine, frequency, material);
    double const effective = effective_mass(machine, frequency, material);
    // A = M_t / sqrt(x^2 + y^2): dA/dx = -A x / (x^2 + y^2), and likewise for y.
    double const by_mass = mass_on_springs(machine, frequency, material) * machine.added_mass.sd;
    auto const damping = damping_of(machine);
    double const by_damping = damping.mean * material * damping.sd;
    return amplitude * material * std::hypot(by_mass, by_damping) / (effective * effective);
}

Exciter exciter_needed(MovedMachine const& machine, double frequency, double material, double amplitude) {
    return {amplitude * effective_mass(machine, frequency, material)};
}

double usual_drive_power(double mass, double amplitude, double frequency) {
    double const force = mass * amplitude * squared_omega(frequency);
    return force * amplitude * 2 * std::numbers::pi * frequency / std::numbers::sqrt2;
}

}  // namespace vibrotrough::learn
