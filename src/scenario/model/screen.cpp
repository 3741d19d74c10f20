#include "scenario/model/screen.hpp"

#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::scenario {

bool is_screen(Scenario const& s) {
    return s.screen.opening.has_value();
}

bool is_batch(Scenario const& s) {
    return is_screen(s) && !is_open(s);
}

bool is_fed_screen(Scenario const& s) {
    return is_screen(s) && is_open(s);
}

bool has_holes(Scenario const& s) {
    return is_screen(s) && *s.screen.opening > 0;
}

double hole_pitch(Screen const& screen) {
    return *screen.opening + *screen.wire;
}

int holes_along(Scenario const& s) {
    if (!has_holes(s)) return 0;
    double const pitches = s.layer.length / hole_pitch(s.screen);
    if (!is_open(s)) return static_cast<int>(std::lround(pitches));
    double const plate = feed_length(s) + largest_excursion(drive_motion(s.trough)) + largest_diameter(s);
    constexpr double rounding = 1e-9;
    return static_cast<int>(std::floor(pitches - plate / hole_pitch(s.screen) + rounding));
}

int cycles_on_screen(Scenario const& s) {
    return std::max(1, static_cast<int>(std::lround(*s.screen.time * s.trough.frequency)));
}

bool has_given_length(Scenario const& s) {
    return !s.stages.empty() || is_batch(s);
}

}  // namespace vibrotrough::scenario
