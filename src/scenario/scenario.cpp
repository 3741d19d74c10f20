#include "scenario/scenario.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace vibrotrough {

double angular_frequency(Trough const& trough) {
    return 2 * std::numbers::pi * trough.frequency;
}

double machine_number(Trough const& trough) {
    double const omega = angular_frequency(trough);
    return omega * omega * trough.amplitude / gravity;
}

double throw_number(Trough const& trough) {
    return machine_number(trough) * std::sin(trough.vibration_angle) / std::cos(trough.inclination);
}

double velocity_scale(Trough const& trough) {
    return angular_frequency(trough) * trough.amplitude * std::cos(trough.vibration_angle);
}

// fmt's "{}" prints the shortest text that reads back as the same double.
std::string to_toml(Scenario const& s) {
    std::string const layer = s.layer.height ? fmt::format("height = \"{} m\"", *s.layer.height)
                                             : fmt::format("grains = {}", s.layer.grains);
    return fmt::format(
               "[campaign]\nname = \"{}\"\n\n"
               "[trough]\ninclination = \"{} radian\"\nvibration_angle = \"{} radian\"\namplitude = \"{} "
               "m\"\n"
               "frequency = \"{} Hz\"\nfriction = {}\nrestitution = {}\n\n",
               s.campaign, s.trough.inclination, s.trough.vibration_angle, s.trough.amplitude,
               s.trough.frequency, s.trough.friction, s.trough.restitution) +
           fmt::format(
               "[grains]\ndiameter = \"{} m\"\ndiameter_spread = {}\ndensity = \"{} kg/m3\"\nyoungs_modulus "
               "= \"{} Pa\"\n"
               "poisson_ratio = {}\nfriction = {}\nrestitution = {}\nrolling_friction = {}\n\n",
               s.grains.diameter, s.grains.diameter_spread, s.grains.density, s.grains.youngs_modulus,
               s.grains.poisson_ratio, s.grains.friction, s.grains.restitution, s.grains.rolling_friction) +
           fmt::format(
               "[layer]\nlength = \"{} m\"\nwidth = \"{} m\"\n{}\n\n"
               "[measure]\npackings = {}\nconfidence = {}\nhalf_width = {}\nmax_cycles = {}\n\n"
               "[output]\nframes_per_cycle = {}\n",
               s.layer.length, s.layer.width, layer, s.measure.packings, s.measure.confidence,
               s.measure.half_width, s.measure.max_cycles, s.output.frames_per_cycle);
}

}  // namespace vibrotrough
