#include "learn/rules_of_thumb.hpp"

#include "theory/limits.hpp"
#include "theory/point_mass.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrotrough::learn {

double rule_of_daesung(theory::Drive const& drive) {
    return 3.81 * (60 * drive.frequency) * drive.amplitude / 60;
}

double speed_without_slip(theory::Drive const& drive) {
    double const throw_number = drive.throw_number();
    if (throw_number <= 1) return 0;
    double low = 0, high = 1;  // cycles of flight
    for (int i = 0; i < 60; ++i) {
        double const middle = (low + high) / 2;
        (theory::throw_number_of_flight(middle) < throw_number ? low : high) = middle;
    }
    double const slope =
        std::cos(drive.inclination) / std::tan(drive.vibration_angle) - std::sin(drive.inclination);
    return 9.81 * low * low / (2 * drive.frequency) * slope;
}

std::optional<double> factor_of_rolling_layers(double throw_number) {
    // "4 deep, free" of validation/why_theory_fails and "throw number" of validation/rolling_layer.
    constexpr std::array<double, 9> at{1.15, 1.35, 1.5, 1.6, 1.7, 1.9, 2.0, 2.15, 2.25};
    constexpr std::array<double, 9> layer{.220, .368, .501, .625, .685, .786, .827, .869, .894};
    if (throw_number < 1.2 || throw_number > 2.3) return {};
    std::size_t i = 1;
    while (i + 1 < at.size() && at[i] < throw_number) ++i;
    double const share = std::min(1.0, (throw_number - at[i - 1]) / (at[i] - at[i - 1]));
    double const efficiency = layer[i - 1] + share * (layer[i] - layer[i - 1]);
    return efficiency / theory::solve(theory::PointMass{throw_number, 0.5, 0, 0.23}).velocity_efficiency;
}

}  // namespace vibrotrough::learn
