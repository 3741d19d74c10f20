#include "learn/exciter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

constexpr double standard_gravity = 9.81;  // m/s^2
constexpr double near_resonance = 0.2;     // of its frequency

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

std::optional<ChosenMotors> choose_motors(std::vector<Motor> const& motors, double static_moment,
                                          double frequency) {
    constexpr double above_its_own = 1.02, converted = 0.9;
    constexpr double most_setting = 0.9;  // so that the stroke can still be raised
    double const turns = 60 * frequency;
    std::optional<Motor> best;
    for (Motor const& one : motors) {
        if (turns > above_its_own * one.rpm || 2 * most_setting * one.static_moment < static_moment) continue;
        bool const is_better =
            !best || one.rpm < best->rpm || (one.rpm == best->rpm && one.static_moment < best->static_moment);
        if (is_better) best = one;
    }
    if (!best) return {};
    return ChosenMotors{*best, static_moment / (2 * best->static_moment), turns < converted * best->rpm};
}

double sag_of(MovedMachine const& machine, double material) {
    return (machine.mass + material) * standard_gravity / machine.spring;
}

double passage_through_resonance(double natural, double frequency, double time) {
    constexpr double overshoot = 1.17;  // of Cornu's spiral over its end
    double const acceleration = 2 * std::numbers::pi * frequency / time;
    return 1 + overshoot * std::numbers::pi * natural * std::sqrt(2 * std::numbers::pi / acceleration);
}

Suspension suspension_of(MovedMachine const& machine, double frequency, double material, double amplitude) {
    if (machine.spring <= 0) throw std::invalid_argument("the machine has no springs");
    double const loaded = resonance_of(machine, material), ratio = frequency / loaded;
    if (ratio <= std::numbers::sqrt2)
        throw std::invalid_argument(fmt::format(
            "springs with a natural frequency of {:.3g} Hz isolate nothing at {:.3g} Hz", loaded, frequency));
    // Far above the resonance the stroke is smaller than at work by this much.
    double const far_above = 1 - 1 / (ratio * ratio);
    return {sag_of(machine, material),
            resonance_of(machine, 0),
            loaded,
            1 - 1 / (ratio * ratio - 1),
            machine.spring * amplitude,
            far_above * passage_through_resonance(loaded, frequency, usual_start),
            far_above * passage_through_resonance(loaded, frequency, usual_stop)};
}

double usual_drive_power(double mass, double amplitude, double frequency) {
    double const force = mass * amplitude * squared_omega(frequency);
    return force * amplitude * 2 * std::numbers::pi * frequency / std::numbers::sqrt2;
}

}  // namespace vibrotrough::learn
