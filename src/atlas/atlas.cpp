#include "atlas/atlas.hpp"

#include "atlas/tables.hpp"
#include "theory/point_mass.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::atlas {
namespace {

/// The atlas' layers have a spread of 0.1; others may be this far from it.
constexpr double least_spread = 0.05, most_spread = 0.2;
/// Grain and trough have the same restitution in the atlas; others may be so far apart.
constexpr double most_restitution_difference = 0.2;

/// Why a layer is of another kind than those of the atlas.
std::vector<Outside> of_another_kind(prepare::PreparedCase const& p) {
    scenario::Scenario const& s = p.scenario;
    std::vector<Outside> all;
    auto const add = [&](bool differs, std::string name, std::string why) {
        if (differs) all.push_back({std::move(name), std::move(why)});
    };
    double const diameter = mean_diameter(s);
    add(s.layer.block != scenario::Block::none, "layer.block", "a block instead of a layer");
    add(is_clump(s.grains), "grains.shape", fmt::format("grains of the shape {}", s.grains.shape));
    add(p.materials.size() > 1, "materials", "several materials");
    add(s.grains.rotation == scenario::Rotation::blocked, "grains.rotation", "grains that do not rotate");
    add(s.engine.contact != scenario::ContactModel::hertz, "engine.contact", "contacts other than Hertz'");
    add(s.engine.cohesion > 0, "engine.cohesion", "cohesion");
    add(s.engine.templates != nullptr, "engine", "commands of the engine of your own");
    // An open trough has walls; smooth ones stand for a piece out of a wide trough.
    bool const has_walls =
        p.domain.open ? s.trough.side_wall_friction > 0.0 : s.trough.side_wall_friction.has_value();
    if (auto const why = has_walls ? why_too_narrow(s.layer.width / diameter) : std::nullopt)
        add(true, "trough.side_wall_friction", *why);
    add(p.domain.has_mesh(), "trough.mesh", "a trough of your own");
    add(p.domain.screen.has_value(), "screen", "a screen");
    add(!p.stages.empty(), "stages", "a drive in stages");
    add(s.trough.waveform || !s.trough.harmonics.empty() || s.trough.along_phase != 0, "trough",
        "a drive that is not one sinusoid along a line");
    return all;
}

/// The numbers of a layer of the atlas' kind, in the order of inputs().
Place numbers_of(prepare::PreparedCase const& p) {
    scenario::Scenario const& s = p.scenario;
    scenario::Trough const& t = s.trough;
    double const diameter = mean_diameter(s);
    bool const rolls = s.grains.rotation == scenario::Rotation::rolling;
    return {p.throw_number,
            t.given.tan_vibration_angle.value_or(std::tan(t.vibration_angle)),
            t.given.tan_inclination.value_or(std::tan(t.inclination)),
            t.friction,
            t.amplitude / diameter,
            p.layer_height / diameter,
            s.grains.friction,
            rolls ? s.grains.rolling_friction : 0,
            (s.grains.restitution + t.restitution) / 2};
}

std::vector<Outside> out_of_range(prepare::PreparedCase const& p, Place const& place) {
    std::vector<Outside> all = outside_ranges(place);
    scenario::Grains const& grains = p.scenario.grains;
    double const spread = grains.size_law == scenario::SizeLaw::listed ? -1 : grains.diameter_spread;
    if (spread < least_spread || spread > most_spread) {
        all.push_back({"diameter_spread",
                       spread < 0 ? "a list of diameters"
                                  : range_text("diameter_spread", spread, least_spread, most_spread)});
    }
    double const difference = std::abs(grains.restitution - p.scenario.trough.restitution);
    if (difference > most_restitution_difference) {
        all.push_back({"trough.restitution",
                       fmt::format("restitutions of grain and trough that differ by {:.2g} (at most {:g})",
                                   difference, most_restitution_difference)});
    }
    return all;
}

/// What is carried over the mass flow of the feed, by a layer of a depth in diameters; NaN without a mean
/// speed.
double carried(prepare::PreparedCase const& p, Place place, double depth) {
    scenario::Scenario const& s = p.scenario;
    place[depth_input] = depth;
    double const speed = efficiency_at(place).value_or(NAN) * p.velocity_scale;
    return bulk_density(s.grains) * s.layer.width * depth * mean_diameter(s) * speed / *s.feed.mass_flow;
}

/// The depth, in diameters, of the layer that carries the feed, if a deeper layer carries more; nothing where
/// the deepest does not move forward. Beyond what the atlas says anything about, it is the depth at the speed
/// there.
std::optional<double> fed_depth(prepare::PreparedCase const& p, Place const& place) {
    SurfaceInput const& input = inputs()[depth_input];
    double low = input.value_at(-farthest), high = input.value_at(1 + farthest);
    double const shallow = carried(p, place, low), deep = carried(p, place, high);
    if (!(deep > 0)) return {};
    if (shallow > 1) return low / shallow;
    if (deep < 1) return high / deep;
    while (high - low > 1e-6) {
        double const middle = (low + high) / 2;
        (carried(p, place, middle) < 1 ? low : high) = middle;
    }
    return low;
}

/// By how much more an error of the atlas changes the speed of a layer that is fed than that of a layer of a
/// given depth: a slower layer is deeper, and has the efficiency of its new depth. From h eta(h) = constant,
/// it is eta / (eta + h d eta / d h) for small errors. Less than 1 counts as 1, because large errors reach
/// depths where that is no longer so; more than `most` counts as that: the feed hardly tells the depth.
double by_its_depth(Place const& place) {
    constexpr double most = 5, step = 0.01;  // over which efficiency is nearly linear
    auto const flow = [&](double share) {
        Place other = place;
        other[depth_input] *= share;
        return share * efficiency_at(other).value_or(NAN);
    };
    double const steepness = (flow(1 + step) - flow(1 - step)) / (2 * step);
    if (!std::isfinite(steepness)) return 1;
    return steepness > 0 ? std::clamp(flow(1) / steepness, 1.0, most) : most;
}

}  // namespace

Answer predict(prepare::PreparedCase const& prepared) {
    Answer answer{{}, {}, {}, of_another_kind(prepared)};
    if (!answer.is_inside()) return answer;
    Place place = numbers_of(prepared);
    if (prepared.domain.open) {
        place[depth_input] = middle_of(depth_input);
        if (is_far_outside(place)) {
            answer.outside = out_of_range(prepared, place);
            return answer;
        }
        auto const depth = fed_depth(prepared, place);
        if (!depth && efficiency_at(place)) {
            answer.outside.push_back({"feed", "a layer that does not move forward"});
            return answer;
        }
        place[depth_input] = depth.value_or(place[depth_input]);
    }
    answer.outside = out_of_range(prepared, place);
    if (is_far_outside(place)) return answer;
    auto const value = value_at(place);
    if (!value) {
        answer.outside.push_back({"theory", "a point mass or rolling layer without a mean speed"});
        return answer;
    }
    answer.efficiency = value->efficiency;
    answer.half_width = value->half_width;
    answer.place = place;
    if (prepared.domain.open) {
        double const depth = place[depth_input] * mean_diameter(prepared.scenario);
        answer.half_width = value->half_width * by_its_depth(place);
        answer.fed_depth = Bounded{depth, depth * *answer.half_width / std::abs(value->efficiency)};
    }
    return answer;
}

std::optional<Place> place_of(prepare::PreparedCase const& prepared) {
    if (prepared.domain.open || !of_another_kind(prepared).empty()) return {};
    return numbers_of(prepared);
}

std::optional<Effects> effects(prepare::PreparedCase const& prepared) {
    if (prepared.domain.open || !predict(prepared).is_inside()) return {};
    constexpr double noticeable = 0.1;  // diameters
    Place const place = numbers_of(prepared);
    Effects found{place[depth_input], {}, {}};
    Place other = place;
    other[depth_input] = inputs()[depth_input].low;
    if (place[depth_input] - other[depth_input] > noticeable)
        found.of_depth = difference_between(place, other);
    if (place[tan_inclination_input] == 0) return found;
    Place level = place;
    level[tan_inclination_input] = 0;
    found.of_slope = difference_between(place, level);
    if (!found.of_slope) return found;
    auto const of_mass = [](Place const& at) {
        theory::PointMass const point{at[throw_number_input], at[tan_vibration_input],
                                      at[tan_inclination_input], at[friction_input]};
        return theory::solve(point).velocity_efficiency;
    };
    found.of_slope->efficiency -= of_mass(place) - of_mass(level);
    return found;
}

}  // namespace vibrotrough::atlas
