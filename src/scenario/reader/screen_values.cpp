#include "scenario/reader/given_values.hpp"

#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// A hole must not be cut by the faces of the periodic box or by side walls.
void check_side(Scenario const& s, char const* key, double side, GivenKeys const& given) {
    constexpr double rounding = 1e-6;
    double const pitch = hole_pitch(s.screen), holes = std::max(1.0, std::round(side / pitch));
    if (std::abs(side - holes * pitch) <= rounding * side) return;
    double const fewer = std::floor(side / pitch) * pitch, more = std::ceil(side / pitch) * pitch;
    given.fail(
        key,
        fmt::format("{} is not a whole number of pitches of {} (screen.opening and screen.wire), so that "
                    "{} would cut through holes",
                    given.text(key, side), given.text("screen.opening", pitch),
                    is_open(s) ? "a side wall" : "the end of the periodic box"),
        fewer > 0 ? fmt::format("write \"{:.9g} mm\" or \"{:.9g} mm\"", 1e3 * fewer, 1e3 * more)
                  : fmt::format("write \"{:.9g} mm\"", 1e3 * more));
}

/// The sheet is made of triangles that are about twice as long as the bars are wide.
void check_holes(Scenario const& s, GivenKeys const& given) {
    constexpr double widest = 20, most_hole_triangles = 1e6;
    double const opening = *s.screen.opening, wire = *s.screen.wire;
    given.require("screen.wire", wire, opening / widest, "a twentieth of the opening");
    if (is_batch(s)) check_side(s, "layer.length", s.layer.length, given);
    check_side(s, "layer.width", s.layer.width, given);
    double const pitch = hole_pitch(s.screen);
    double const triangles = s.layer.length * s.layer.width / (pitch * pitch) * 4 * (opening / wire + 4);
    given.require_at_most("screen.opening", triangles, most_hole_triangles, "triangles of the screen",
                          "make the box smaller, or are the units right?");
}

/// Behind the plate under the feed there must be room for holes.
void check_fed_screen(Scenario const& s, GivenKeys const& given) {
    if (!has_holes(s) || holes_along(s) >= 1) return;
    given.fail("layer.length",
               fmt::format("there is no room for a hole of {} behind the feed, which falls onto the first {}",
                           given.text("screen.opening", *s.screen.opening),
                           given.text("layer.length", feed_length(s))),
               "lengthen the screen, or shorten feed.length");
}

}  // namespace

void complete_screen(Scenario& s, GivenKeys const& given) {
    if (!is_screen(s)) return;
    if (has_holes(s)) check_holes(s, given);
    if (is_open(s)) return check_fed_screen(s, given);
    constexpr int most_cycles = 1'000'000;
    if (*s.screen.time * s.trough.frequency > most_cycles)
        given.fail("screen.time", fmt::format("is more than {} cycles", most_cycles), "write a shorter time");
    s.measure.max_cycles = cycles_on_screen(s);
    s.measure.max_packings = s.measure.packings;
}

}  // namespace vibrotrough::scenario
