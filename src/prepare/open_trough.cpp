#include "prepare/open_trough.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrotrough::prepare {
namespace {

/// m/s, of a grain of the feed that fell to the floor and downhill to the edge: a collision may turn it in
/// any direction.
double speed_of_feed(OpenTrough const& open, PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    double const alpha = s.trough.inclination, downhill = std::max(0.0, -std::sin(alpha)) * s.layer.length;
    double const drop = std::cos(alpha) * open.feed_top + downhill;
    return std::sqrt(open.feed_speed * open.feed_speed + 2 * s.trough.gravity * drop);
}

/// How much faster a light grain of a mixture can be than a heavy one that hits it: 2 M / (M + m), of an
/// elastic impact of the heaviest grain on the lightest one at rest. Of one material 1, whatever its sizes
/// are: in the validation cases none has left a box half as wide. A grain that leaves the box ends the run.
double speed_of_light_grains(PreparedCase const& c) {
    if (c.materials.size() < 2) return 1;
    double heaviest = 0, lightest = std::numeric_limits<double>::infinity();
    for (ClassCount const& size : c.classes) {
        double const density = c.materials[static_cast<std::size_t>(size.material)].grains.density;
        double const mass = density * std::pow(size.diameter, 3);
        heaviest = std::max(heaviest, mass);
        lightest = std::min(lightest, mass);
    }
    return 2 * heaviest / (heaviest + lightest);
}

/// m, the way of a grain in a cycle, with the speed with which the trough throws it, from the highest point
/// of its floor to the lowest one, or with this one.
double longest_flight(OpenTrough const& open, PreparedCase const& c, double fed) {
    double const thrown = std::hypot(2 * speed_of_light_grains(c) * c.largest_speed,
                                     std::sqrt(2 * c.scenario.trough.gravity * c.domain.floor_top));
    return std::max(thrown, fed) * open.longest_cycle + 2 * c.largest_extent;
}

/// m, the lowest and the highest point of the trough in its last part of this length.
std::array<double, 2> heights_near_edge(scenario::Scenario const& s, double part) {
    if (!s.trough.mesh) return {0, 0};
    double const unit = metres_in(s.trough.mesh_unit), end = s.trough.mesh->extent[0];
    auto const [lowest, highest] = s.trough.mesh->heights_between(end - part / unit, end);
    return {unit * lowest, unit * highest};
}

/// What has passed a screen falls below it, up to a cycle long, in all directions. The wall below the edge
/// leaves a gap that no grain fits through, so that no grain touches both meshes at once.
void add_screen(OpenTrough& open, PreparedCase const& c, double fall) {
    scenario::Scenario const& s = c.scenario;
    double const grain = c.largest_extent, excursion = c.largest_excursion;
    double const flight = longest_flight(open, c, speed_of_feed(open, c));
    open.box_bottom = -(grain + flight + fall + 3 * excursion);
    open.box_start -= open.bin * std::ceil(flight / open.bin);
    open.box_end =
        std::max(open.box_end, open.out_x + flight + fall * std::abs(std::sin(s.trough.inclination)));
    open.box_side = std::max(open.box_side, flight);
    open.out_near_x = s.layer.length;
    open.end_wall = {-smallest_diameter(s) / 4, open.box_bottom + excursion + grain / 2};
}

}  // namespace

OpenTrough open_trough(PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    double const grain = c.largest_extent, excursion = c.largest_excursion;
    OpenTrough open{};
    open.longest_cycle =
        c.stages.empty() ? 1 / s.trough.frequency : std::ranges::max(cycle_durations(c.stages));
    double const period = open.longest_cycle, length = s.layer.length;
    open.feed_start = excursion + 0.1 * grain;  // the back wall moves
    open.feed_end = open.feed_start + feed_length(s);
    open.feed_bottom = feed_height(s);
    open.feed_speed = feed_speed(s);
    open.feed_top = open.feed_bottom + open.feed_speed * period / feeds_per_cycle + grain;
    double const way = length - open.feed_end;
    open.window_start = open.feed_end + way / 3;
    open.window_end = length - way / 6;
    // Grains that have left are taken out once per cycle, until when they fly and fall on.
    open.out_x = length + excursion + grain;
    // What falls from a high place of the edge may fly back below the trough on its way to the lowest one.
    double const near = excursion + grain;
    auto const [lowest, highest] = heights_near_edge(s, near);
    double const behind = highest - lowest;
    open.out_near_x = length - excursion - grain - behind;
    open.out_z = heights_near_edge(s, near + behind)[0] - near;
    // A grain of the feed can be thrown to the edge, as far as a ballistic flight is long at most (v^2 / g),
    // with the speed of its fall. The box of a longer trough is not made longer for it.
    double const fed = speed_of_feed(open, c);
    double const flight = longest_flight(open, c, way < fed * fed / s.trough.gravity ? fed : 0);
    double const fall = s.trough.gravity * period * period / 2;
    open.bin = length / std::round(length / (2 * mean_diameter(s)));
    open.box_start = -open.bin * std::ceil((excursion + 2 * grain) / open.bin);
    open.box_end = open.out_x + flight + fall * std::abs(std::sin(s.trough.inclination));
    // Sideways the margin was narrowest when a light grain of a mixture left the box
    // (validation/history).
    open.box_side = c.materials.size() > 1 ? flight : flight / 2;
    open.box_bottom = std::min(open.out_z, -near) - flight - fall;
    if (is_screen(s)) add_screen(open, c, fall);
    return open;
}

}  // namespace vibrotrough::prepare
