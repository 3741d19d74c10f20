#include "scenario/model/softness.hpp"

#include "scenario/model/materials.hpp"
#include "scenario/model/stages.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::scenario {
namespace {

constexpr double softest_simulated = 2e6;
constexpr double largest_of_key = 1e12;  // scenario/reader/grains_keys.cpp
constexpr double modulus_of_blocks = 5e6;

/// The largest wave number of all stages of the drive.
double largest_wave_number(Scenario const& s, double modulus) {
    if (s.stages.empty()) return wave_number(s, modulus);
    Scenario steady = s;
    steady.stages.clear();
    double largest = 0;
    for (Stage const& stage : stages(s)) {
        steady.trough = stage.trough;
        largest = std::max(largest, wave_number(steady, modulus));
    }
    return largest;
}

}  // namespace

double wave_number(Scenario const& s, double modulus) {
    double const density = mean_density(s), depth = layer_height(s);
    double const pressure = settled_solid_fraction * density * depth * s.trough.gravity *
                            std::cos(s.trough.inclination) * (1 + throw_number(s.trough)) / 2;
    double const effective = modulus / (2 * (1 - s.grains.poisson_ratio * s.grains.poisson_ratio));
    double const wave = std::cbrt(effective / density) * std::pow(pressure / density, 1.0 / 6);
    return angular_frequency(s.trough) * depth / wave;
}

double stiff_enough(Scenario const& s, double limit) {
    // s goes with E^(-1/3).
    double const needed = std::pow(largest_wave_number(s, 1) / limit, 3);
    constexpr double rounding = 1 - 1e-12;
    for (double decade = 1e6; decade < largest_of_key; decade *= 10) {
        for (double const step : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
            double const modulus = step * decade;
            if (modulus >= softest_simulated && modulus >= rounding * needed) return modulus;
        }
    }
    return largest_of_key;
}

void choose_modulus(std::span<Scenario> cases) {
    double modulus = 0;
    for (Scenario const& s : cases) {
        if (s.grains.youngs_modulus) continue;
        bool const is_block = s.layer.block != Block::none;
        modulus = std::max(modulus, is_block ? modulus_of_blocks : stiff_enough(s, s.solver.softness));
    }
    for (Scenario& s : cases) give_modulus(s, modulus);
}

void give_modulus(Scenario& s, std::optional<double> modulus) {
    if (!modulus || s.grains.youngs_modulus) return;
    s.grains.youngs_modulus = modulus;
    s.grains.is_modulus_chosen = true;
}

}  // namespace vibrotrough::scenario
