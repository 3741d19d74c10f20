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

/// The layers of the smallest distance, nearest first.
template <class Distance>
std::vector<LayerMotion> nearest_of(std::vector<LayerMotion> const& layers, int count,
                                    Distance const& distance) {
    std::vector<LayerMotion> nearest(static_cast<std::size_t>(count));
    std::ranges::partial_sort_copy(layers, nearest, {}, distance, distance);
    return nearest;
}

}  // namespace

LikelyMode mode_at(Place const& place) {
    auto const nearest = nearest_of(layers(), layers_asked, [&](LayerMotion const& layer) {
        return distance_between(layer.place, place);
    });
    auto const agreeing = [&](LayerMotion const& one) {
        return static_cast<int>(std::ranges::count(nearest, one.mode, &LayerMotion::mode));
    };
    // Of modes with as many layers, the one of the nearest.
    LayerMotion const& found = *std::ranges::max_element(nearest, {}, agreeing);
    return {found.mode, agreeing(found)};
}

int repeating_later(double throw_number) {
    static std::vector<LayerMotion> const known = [] {
        std::vector<LayerMotion> some;
        std::ranges::copy_if(layers(), std::back_inserter(some),
                             [](LayerMotion const& one) { return one.period.has_value(); });
        return some;
    }();
    auto const nearest = nearest_of(known, layers_asked_for_period, [&](LayerMotion const& layer) {
        return std::abs(layer.place[throw_number_input] - throw_number);
    });
    auto const is_later = [](LayerMotion const& layer) { return *layer.period > 1; };
    return static_cast<int>(std::ranges::count_if(nearest, is_later));
}

}  // namespace vibrotrough::atlas
