#include "deck/deck_data.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vibrotrough::deck {
namespace {

/// Counts whose running sums are the nearest to the fractions': the mean stays the mean, and a single grain
/// is of the middle size.
std::vector<ClassCount> count_classes(scenario::Grains const& grains, int count) {
    std::vector<ClassCount> classes;
    double fraction = 0;
    int so_far = 0;
    for (scenario::SizeClass const& size : size_classes(grains)) {
        fraction += size.number_fraction;
        int const target = static_cast<int>(std::lround(fraction * count));
        if (target > so_far) classes.push_back({size.diameter, target - so_far});
        so_far = std::max(so_far, target);
    }
    return classes;
}

/// The smallest of unit, 4 unit, 16 unit ... that is enough: cases that differ by their drives share a box.
double in_powers_of_four(double unit, double needed) {
    while (unit < needed) unit *= 4;
    return unit;
}

}  // namespace

DeckNumbers make_numbers(scenario::Scenario const& s) {
    DeckNumbers n{};
    n.classes = count_classes(s.grains, s.layer.grains);
    if (s.layer.block == scenario::Block::plate) n.clump = make_plate(s.grains.diameter);
    if (is_clump(s.grains)) n.clump = make_clump(s.grains);
    double const ratio = n.clump ? 2 * n.clump->bounding_radius / s.grains.diameter : 1;
    double bounding_volume = 0;
    for (ClassCount const& size : n.classes) {
        double const sphere = std::numbers::pi / 6 * std::pow(size.diameter, 3);
        n.mass += size.count * s.grains.density * (n.clump ? n.clump->volume : sphere);
        bounding_volume += size.count * sphere * std::pow(ratio, 3);
    }
    n.largest_extent = n.classes.front().diameter * ratio;
    // Poured loosely: at a solid fraction of 0.2 random insertion always finds room.
    double const width = s.layer.width - (s.trough.side_wall_friction ? n.largest_extent : 0);
    n.fill_bottom = 0.6 * n.largest_extent;
    n.fill_top = n.fill_bottom + n.largest_extent +
                 bounding_volume / (0.2 * s.layer.length * std::max(width, 0.2 * s.layer.width));
    n.settle_time_step = settling_time_step(s, n.fill_top);
    n.time = choose_time_step(s);
    // A grain at ten times the height that the trough's largest speed throws it to is still in the box.
    scenario::DriveMotion const motion = drive_motion(s.trough);
    double const speed = largest_speed(motion, angular_frequency(s.trough));
    double const flight = speed * speed / (2 * scenario::gravity * std::cos(s.trough.inclination));
    double const excursion = largest_excursion(motion);
    n.box_top = in_powers_of_four(8 * (n.fill_top + 5 * n.largest_extent),
                                  n.fill_top + 10 * flight + 5 * n.largest_extent);
    n.box_bottom = -in_powers_of_four(4 * n.largest_extent, 2 * (excursion + n.largest_extent));
    n.wall_height = n.box_top - (excursion - n.box_bottom);
    return n;
}

}  // namespace vibrotrough::deck
