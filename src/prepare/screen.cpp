#include "prepare/screen.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::prepare {

ScreenFloor screen_floor(PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    double const grain = c.largest_extent;
    ScreenFloor floor{};
    if (has_holes(s)) {
        double const pitch = hole_pitch(s.screen);
        floor.along = holes_along(s);
        floor.across = static_cast<int>(std::lround(s.layer.width / pitch));
        if (is_open(s)) floor.plate = s.layer.length - floor.along * pitch;
    }
    floor.out_z = -grain / 2;
    // What falls in a cycle, all grains at most, must find room there without reaching up to the screen,
    // which moves down by twice its excursion at most.
    floor.catch_z = -(2 * c.largest_excursion + c.layer_height + 3 * grain);
    return floor;
}

double passage_probability(scenario::Screen const& screen, double diameter) {
    if (diameter >= *screen.opening) return 0;
    double const share = (*screen.opening - diameter) / hole_pitch(screen);
    return share * share;
}

}  // namespace vibrotrough::prepare
