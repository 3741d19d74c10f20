#include "scenario/model/feed.hpp"

#include "scenario/model/scenario.hpp"

#include <algorithm>

namespace vibrotrough::scenario {

bool is_open(Scenario const& s) {
    return s.feed.mass_flow.has_value();
}

double expected_speed(Scenario const& s) {
    return std::clamp(0.9 * (throw_number(s.trough) - 0.9), 0.1, 0.95) * velocity_scale(s.trough);
}

double feed_length(Scenario const& s) {
    return s.feed.length.value_or(std::max(0.1 * s.layer.length, 4 * largest_diameter(s)));
}

double feed_height(Scenario const& s) {
    return s.feed.height.value_or(2 * layer_height(s) + 6 * largest_diameter(s));
}

double feed_speed(Scenario const& s) {
    constexpr double solid_fraction = 0.15;
    double const area = feed_length(s) * s.layer.width;
    return *s.feed.mass_flow / (solid_fraction * mean_density(s) * area);
}

}  // namespace vibrotrough::scenario
