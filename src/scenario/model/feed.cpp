#include "scenario/model/feed.hpp"

#include "scenario/model/scenario.hpp"

#include <algorithm>

namespace vibrotrough::scenario {
namespace {

/// m, how far along the trough the stream may fall, which the trough moves under.
double reach_of_feed(Scenario const& s) {
    return feed_length(s) + 2 * largest_excursion(drive_motion(s.trough)) + largest_diameter(s);
}

}  // namespace

bool is_open(Scenario const& s) {
    return s.feed.mass_flow.has_value();
}

double expected_speed(Scenario const& s) {
    return std::clamp(0.9 * (throw_number(s.trough) - 0.9), 0.1, 0.95) * velocity_scale(s.trough);
}

double feed_length(Scenario const& s) {
    return s.feed.length.value_or(std::max(0.1 * s.layer.length, 4 * largest_diameter(s)));
}

double feed_width(Scenario const& s) {
    return s.feed.width.value_or(s.layer.width);
}

double floor_under_feed(Scenario const& s) {
    if (!s.trough.mesh) return 0;
    double const unit = metres_in(s.trough.mesh_unit);
    return unit * s.trough.mesh->heights_between(0, reach_of_feed(s) / unit)[1];
}

double layer_under_feed(Scenario const& s) {
    if (!s.trough.mesh) return layer_height(s);
    double const unit = metres_in(s.trough.mesh_unit);
    return unit * s.trough.mesh->level_across(mean_layer_depth(s) / unit, 0, reach_of_feed(s) / unit).height;
}

double feed_height(Scenario const& s) {
    return s.feed.height.value_or(floor_under_feed(s) + (2 * layer_height(s) + 6 * largest_diameter(s)));
}

double feed_speed(Scenario const& s) {
    constexpr double solid_fraction = 0.15;
    double const area = feed_length(s) * feed_width(s);
    return *s.feed.mass_flow / (solid_fraction * mean_density(s) * area);
}

}  // namespace vibrotrough::scenario
