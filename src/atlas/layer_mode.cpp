#include "atlas/layer_mode.hpp"

#include "atlas/tables.hpp"
#include "atlas/value.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vibrotrough::atlas {

LikelyMode mode_at(Place const& place) {
    static std::vector<LayerMotion> const layers = read_modes(layers_table, "layers.csv");
    auto const distance = [&](LayerMotion const& layer) { return distance_between(layer.place, place); };
    std::vector<LayerMotion> nearest(layers_asked);
    std::ranges::partial_sort_copy(layers, nearest, {}, distance, distance);
    auto const agreeing = [&](LayerMotion const& one) {
        return static_cast<int>(std::ranges::count(nearest, one.mode, &LayerMotion::mode));
    };
    // Of modes with as many layers, the one of the nearest.
    LayerMotion const& found = *std::ranges::max_element(nearest, {}, agreeing);
    return {found.mode, agreeing(found)};
}

}  // namespace vibrotrough::atlas
