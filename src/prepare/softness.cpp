#include "prepare/softness.hpp"

#include "prepare/contact.hpp"

#include <cmath>

namespace vibrotrough::prepare {
namespace {

// validation/deep_layers, section 3. Its run.py fails when these factors are not those of its stored layers.
constexpr double factor_of_bound = 4;   ///< |error| <= 4 s^2 for all but a few layers
constexpr double factor_of_middle = 1;  ///< and s^2 for the one in the middle

constexpr double softest_simulated = 2e6;
constexpr double largest_of_key = 1e12;  // scenario/reader/keys.cpp

}  // namespace

double wave_number(scenario::Scenario const& s, double modulus) {
    scenario::Grains grains = s.grains;
    grains.youngs_modulus = modulus;
    grains.density = mean_density(s);
    double const depth = layer_height(s);
    double const gravity = scenario::gravity * std::cos(s.trough.inclination);
    double const pressure = scenario::settled_solid_fraction * grains.density * depth * gravity *
                            (1 + throw_number(s.trough)) / 2;
    double const wave =
        std::cbrt(effective_modulus(grains) / grains.density) * std::pow(pressure / grains.density, 1.0 / 6);
    return angular_frequency(s.trough) * depth / wave;
}

double softness_bound(scenario::Scenario const& s, double modulus) {
    return factor_of_bound * std::pow(wave_number(s, modulus), 2);
}

bool is_soft(scenario::Scenario const& s) {
    if (s.layer.block != scenario::Block::none) return false;
    double const middle =
        softness_bound(s, s.grains.youngs_modulus.value()) * factor_of_middle / factor_of_bound;
    return middle > s.measure.half_width / 2;
}

double stiff_enough(scenario::Scenario const& s, double error) {
    // s goes with E^(-1/3).
    double const needed = std::pow(wave_number(s, 1) / std::sqrt(error / factor_of_bound), 3);
    constexpr double rounding = 1 - 1e-12;
    for (double decade = 1e6; decade < largest_of_key; decade *= 10) {
        for (double const step : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
            double const modulus = step * decade;
            if (modulus >= softest_simulated && modulus >= rounding * needed) return modulus;
        }
    }
    return largest_of_key;
}

}  // namespace vibrotrough::prepare
