#include "atlas/layer_load.hpp"

#include "atlas/tables.hpp"

#include <cmath>
#include <numbers>

namespace vibrotrough::atlas {
namespace {

/// A number of the layers over the inputs of the atlas, without a trend.
Bounded value_of(Surface const& surface, Place const& place) {
    SurfaceValue const found = surface.at(place, 0);
    return {found.efficiency, std::hypot(found.half_width, scatter_half_width(surface))};
}

}  // namespace

LayerLoad load_at(Place const& place) {
    static Surface const added_mass(inputs(), read_column(layers_table, "layers.csv", "added_mass"),
                                    read_draws(added_mass_draws_table, "draws_added_mass.csv"));
    static Surface const damping(inputs(), read_column(layers_table, "layers.csv", "damping"),
                                 read_draws(damping_draws_table, "draws_damping.csv"));
    return {value_of(added_mass, place), value_of(damping, place)};
}

std::optional<Bounded> power_per_mass(LayerLoad const& load, double amplitude, double frequency) {
    if (!(load.damping.value > 0)) return {};
    double const omega = 2 * std::numbers::pi * frequency;
    double const each = std::pow(omega, 3) * amplitude * amplitude / 2;
    return Bounded{each * load.damping.value, each * load.damping.half_width};
}

}  // namespace vibrotrough::atlas
