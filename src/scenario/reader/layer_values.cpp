#include "scenario/reader/given_values.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr std::size_t most_spheres = 100'000'000;  // of a layer
constexpr double most_grains_on_floor = 1e6;

void check_box(std::string_view key, double side, double largest, GivenKeys const& given) {
    if (side >= 4 * largest) return;
    given.fail(key,
               fmt::format("{:.6g} m is less than 4 diameters of the largest grains ({:.6g} m each), so that "
                           "grains would touch their own periodic images",
                           side, largest),
               fmt::format("write at least \"{:.6g} mm\"", 4e3 * largest));
}

/// The floor's mesh has a triangle for every few grains on it.
void check_floor(Layer const& layer, double diameter, GivenKeys const& given) {
    double const grains = layer.length * layer.width / (diameter * diameter);
    if (grains <= most_grains_on_floor) return;
    given.fail("layer.length",
               fmt::format("{:.3g} grains of {:.3g} m would lie side by side on the floor, more than {:.0f}",
                           grains, diameter, most_grains_on_floor),
               "make the box smaller or the grains larger; is the unit of the diameter right?");
}

int grains_for(double height, Scenario const& scenario, GivenKeys const& given) {
    double const diameter = mean_diameter(scenario);
    if (height < diameter) {
        given.fail("layer.height", fmt::format("{:.6g} m is less than one grain diameter", height),
                   fmt::format("write at least \"{:.6g} mm\"", 1e3 * diameter));
    }
    double const count = settled_solid_fraction * scenario.layer.length * scenario.layer.width * height /
                         mean_grain_volume(scenario);
    Key const& key = *find_key("layer.grains");
    if (count > key.most) {
        given.fail("layer.height",
                   fmt::format("the layer would need {:.3g} grains, more than {:.0f}", count, key.most),
                   "make the layer smaller or the grains larger");
    }
    return std::max(1, static_cast<int>(std::lround(count)));
}

/// Every material has at least one grain.
void check_counts(Scenario const& scenario, GivenKeys const& given) {
    for (Material const& material : materials(scenario)) {
        if (material.number_fraction * scenario.layer.grains >= 1) continue;
        given.fail(given.has("layer.height") ? "layer.height" : "layer.grains",
                   fmt::format("the layer has {} grains, and fewer than one grain of '{}'",
                               scenario.layer.grains, material.name),
                   "take a larger layer or a larger share");
    }
}

}  // namespace

void complete_layer(Scenario& scenario, GivenKeys const& given) {
    Layer& layer = scenario.layer;
    double const largest = largest_diameter(scenario);
    check_box("layer.length", layer.length, largest, given);
    check_box("layer.width", layer.width, largest, given);
    check_floor(layer, largest, given);
    if (layer.block != Block::none) layer.grains = 1;
    if (layer.height) layer.grains = grains_for(*layer.height, scenario, given);
    check_counts(scenario, given);
    std::size_t const spheres =
        static_cast<std::size_t>(layer.grains) * shape_spheres(scenario.grains).size();
    if (spheres > most_spheres)
        given.fail("grains.shape", fmt::format("the layer would need {} spheres", spheres),
                   "take fewer grains");
}

}  // namespace vibrotrough::scenario
