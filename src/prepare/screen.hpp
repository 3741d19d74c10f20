#pragma once

#include "prepare/domain.hpp"
#include "prepare/prepared_case.hpp"

namespace vibrotrough::prepare {

/// Holes and depth of a screen. Grains, drive and time grid of the case must be known.
ScreenFloor screen_floor(PreparedCase const& prepared);

/// Probability that a sphere which falls straight down at a random place on a screen with square holes passes
/// without touching it: ((a - d) / (a + w))^2 for the diameter d, the opening a and the width w of the bars;
/// 0 when the sphere is not smaller than the opening (A.M. Gaudin, Principles of Mineral Dressing, 1939;
/// Wills and Finch, Wills' Mineral Processing Technology, 8th ed. 2016, ch. 8). It neglects that a sphere
/// which touches a bar may still be turned into the hole, other grains, and the motion of the screen.
double passage_probability(scenario::Screen const& screen, double diameter);

}  // namespace vibrotrough::prepare
