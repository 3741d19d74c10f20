#pragma once

#include <optional>

/// @file
/// A vibrating screen: a floor with holes through which small grains fall.

namespace vibrotrough::scenario {

struct Scenario;

/// A flat sheet without thickness with square holes in rows and columns. What falls through it is counted and
/// taken out. A batch of grains lies on a piece of an endless screen, or the screen is the floor of an open
/// trough: it is fed at one end, and what stays on it leaves over the edge at the other. A trough without an
/// opening is not a screen.
struct Screen {
    std::optional<double> opening = {};  ///< m, side of the holes; 0 for a screen without holes
    std::optional<double> wire = {};     ///< m, width of the bars between two holes
    std::optional<double> time = {};     ///< s, how long a batch is on the screen
};

/// Whether the floor is a screen.
bool is_screen(Scenario const& scenario);

/// Whether a batch of grains lies on a screen for a time.
bool is_batch(Scenario const& scenario);

/// Whether the floor is a screen that grains are fed to.
bool is_fed_screen(Scenario const& scenario);

/// Whether the floor is a screen with holes.
bool has_holes(Scenario const& scenario);

/// Distance from hole to hole, m. @pre both numbers are given
double hole_pitch(Screen const& screen);

/// How many holes are in a row along the trough; 0 without holes. A screen that is fed begins with a plate
/// under the feed, as long as the zone that the feed falls into, the way of the back wall, and a grain;
/// behind it come as many holes as there is room for, with half a bar at the edge.
int holes_along(Scenario const& scenario);

/// The number of whole cycles in which the batch is on the screen, at least 1. @pre the time is given
int cycles_on_screen(Scenario const& scenario);

/// Whether the campaign file says how long every packing runs and how many there are: with stages of the
/// drive, and with a batch on a screen. Then nothing is added until an interval is narrow enough.
bool has_given_length(Scenario const& scenario);

}  // namespace vibrotrough::scenario
