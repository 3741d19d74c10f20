#include "measure/reaction.hpp"

#include "measure/constants.hpp"

#include <cmath>
#include <complex>

namespace vibrotrough::measure {
namespace {

using Complex = std::complex<double>;
constexpr double interval = two_pi / PhaseSeries::per_cycle;  // rad

/// The first harmonic of the drive in a curve over one or more cycles: value(phase) = Re(result e^(i phase)).
/// @param offset  of the values from the ends of their intervals, rad
Complex first_harmonic(std::vector<double> const& values, double offset) {
    Complex sum = 0;
    for (std::size_t j = 0; j < values.size(); ++j)
        sum += values[j] * std::polar(1.0, -(static_cast<double>(j + 1) * interval - offset));
    return 2.0 * sum / static_cast<double>(values.size());
}

/// The same of a curve whose values are means over the intervals: the mean of cos(phase) over an interval is
/// that in its middle times sin(interval / 2) / (interval / 2).
Complex first_harmonic_of_means(std::vector<double> const& values) {
    return first_harmonic(values, interval / 2) * (interval / 2) / std::sin(interval / 2);
}

/// Mean of force times velocity; the mean velocity of an interval is that of its ends.
double mean_power(std::vector<double> const& force, std::vector<double> const& velocity) {
    double sum = 0, before = velocity.back();
    for (std::size_t j = 0; j < force.size(); ++j) {
        sum += force[j] * (before + velocity[j]) / 2;
        before = velocity[j];
    }
    return sum / static_cast<double>(force.size());
}

}  // namespace

std::optional<Reaction> layer_reaction(PhaseCurves const& curves, double frequency) {
    if (curves.phase.empty()) return {};
    Complex const along = first_harmonic(curves.trough_velocity_x, 0),
                  normal = first_harmonic(curves.trough_velocity_z, 0);
    double const square = std::norm(along) + std::norm(normal);
    if (!(square > 0)) return {};
    // The normal force is positive when it presses the trough down.
    Complex const power = first_harmonic_of_means(curves.tangential_force) * std::conj(along) -
                          first_harmonic_of_means(curves.normal_force) * std::conj(normal);
    Complex const impedance = -power / square;
    return Reaction{impedance.imag() / (two_pi * frequency), impedance.real(),
                    mean_power(curves.normal_force, curves.trough_velocity_z) -
                        mean_power(curves.tangential_force, curves.trough_velocity_x)};
}

void add_reaction(LayerMotion& motion, double frequency) {
    auto const reaction = layer_reaction(motion.curves, frequency);
    if (!reaction) return;
    motion.added_mass = reaction->added_mass;
    motion.damping = reaction->damping;
    motion.trough_power = reaction->power;
}

}  // namespace vibrotrough::measure
