#include "scenario/model/screen.hpp"

#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::scenario {

bool is_screen(Scenario const& s) {
    return s.screen.opening.has_value();
}

bool has_holes(Scenario const& s) {
    return is_screen(s) && *s.screen.opening > 0;
}

double hole_pitch(Screen const& screen) {
    return *screen.opening + *screen.wire;
}

int cycles_on_screen(Scenario const& s) {
    return std::max(1, static_cast<int>(std::lround(*s.screen.time * s.trough.frequency)));
}

bool has_given_length(Scenario const& s) {
    return !s.stages.empty() || is_screen(s);
}

}  // namespace vibrotrough::scenario
