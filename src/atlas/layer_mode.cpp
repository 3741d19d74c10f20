#include "atlas/layer_mode.hpp"

#include "atlas/tables.hpp"
#include "atlas/value.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace vibrotrough::atlas {
namespace {

std::vector<LayerMotion> const& layers() {
    static std::vector<LayerMotion> const all = read_motions(layers_table, "layers.csv");
    return all;
}

/// The layers that are most alike, nearest first.
std::vector<LayerMotion> nearest_of(std::vector<LayerMotion> const& layers, Place const& place, int count) {
    auto const distance = [&](LayerMotion const& layer) { return distance_between(layer.place, place); };
    std::vector<LayerMotion> nearest(static_cast<std::size_t>(count));
    std::ranges::partial_sort_copy(layers, nearest, {}, distance, distance);
    return nearest;
}

bool is_later(LayerMotion const& layer) {
    return layer.period.value_or(1) > 1;
}

}  // namespace

LikelyMode mode_at(Place const& place) {
    auto const nearest = nearest_of(layers(), place, layers_asked);
    auto const agreeing = [&](LayerMotion const& one) {
        return static_cast<int>(std::ranges::count(nearest, one.mode, &LayerMotion::mode));
    };
    // Of modes with as many layers, the one of the nearest.
    LayerMotion const& found = *std::ranges::max_element(nearest, {}, agreeing);
    return {found.mode, agreeing(found)};
}

int repeating_later(Place const& place) {
    static std::vector<LayerMotion> const known = [] {
        std::vector<LayerMotion> some;
        std::ranges::copy_if(layers(), std::back_inserter(some),
                             [](auto const& one) { return one.period.has_value(); });
        return some;
    }();
    return static_cast<int>(
        std::ranges::count_if(nearest_of(known, place, layers_asked_for_period), is_later));
}

}  // namespace vibrotrough::atlas
