#pragma once

#include <optional>

/// @file
/// A vibrating screen: a floor with holes through which small grains fall.

namespace vibrotrough::scenario {

struct Scenario;

/// A batch of grains on an endless screen, a flat sheet without thickness with square holes in rows and
/// columns. What falls through it is counted and taken out. A trough without an opening is not a screen.
struct Screen {
    std::optional<double> opening = {};  ///< m, side of the holes; 0 for a screen without holes
    std::optional<double> wire = {};     ///< m, width of the bars between two holes
    std::optional<double> time = {};     ///< s, how long the batch is on the screen
};

/// Whether the floor is a screen.
bool is_screen(Scenario const& scenario);

/// Whether the floor is a screen with holes.
bool has_holes(Scenario const& scenario);

/// Distance from hole to hole, m. @pre both numbers are given
double hole_pitch(Screen const& screen);

/// The number of whole cycles in which the batch is on the screen, at least 1. @pre the time is given
int cycles_on_screen(Scenario const& scenario);

/// Whether the campaign file says how long every packing runs and how many there are: with stages of the
/// drive, and with a screen. Then nothing is added until an interval is narrow enough.
bool has_given_length(Scenario const& scenario);

}  // namespace vibrotrough::scenario
