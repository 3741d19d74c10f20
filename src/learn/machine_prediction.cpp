#include "learn/machine_prediction.hpp"

#include "atlas/tables.hpp"
#include "learn/machine_keys.hpp"
#include "theory/rolling_layer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace vibrotrough::learn {
namespace {

/// The numbers of the atlas, with what is not exact at its mean.
atlas::KnownNumbers numbers_of(ExistingMachine const& m) {
    theory::Drive const& d = m.drive;
    auto const& diameter = m.grains.diameter;
    auto const mean = [](std::optional<Uncertain> const& one) {
        return one ? std::optional(one->mean) : std::nullopt;
    };
    return {d.throw_number(),
            std::tan(d.vibration_angle),
            std::tan(d.inclination),
            m.friction.mean,
            diameter ? std::optional(d.amplitude / *diameter) : std::nullopt,
            diameter && m.depth ? std::optional(*m.depth / *diameter) : std::nullopt,
            mean(m.grains.friction),
            mean(m.grains.rolling_friction),
            std::nullopt};
}

std::vector<std::string> unknown_of(ExistingMachine const& m) {
    std::vector<std::string> all;
    if (!m.grains.diameter) all.emplace_back("the size of the grains");
    if (!m.depth) all.emplace_back("the depth of the layer");
    if (!m.grains.rolling_friction) all.emplace_back("the rolling friction");
    if (!m.grains.friction) all.emplace_back("the friction between grains");
    all.emplace_back("the restitution");
    return all;
}

/// An input that is known, but not exactly.
struct InexactInput {
    atlas::Input input;
    Uncertain value;
};

std::vector<InexactInput> inexact_of(ExistingMachine const& m) {
    std::vector<InexactInput> all;
    auto const add = [&](atlas::Input input, std::optional<Uncertain> const& known) {
        if (known && known->sd > 0) all.push_back({input, *known});
    };
    add(atlas::friction_input, m.friction);
    add(atlas::rolling_friction_input, m.grains.rolling_friction);
    add(atlas::grain_friction_input, m.grains.friction);
    return all;
}

/// Standard deviation of the efficiency by what is not known exactly: each input alone.
double sd_of_inexact(ExistingMachine const& m, atlas::Place const& place) {
    double squares = 0;
    for (auto const& [input, value] : inexact_of(m)) {
        atlas::SurfaceInput const& range = atlas::inputs()[input];
        atlas::Place other = place;
        squares += std::pow(deviation_within({range.low, range.high}, value,
                                             [&](double at) {
                                                 other[input] = at;
                                                 return atlas::efficiency_at(other);
                                             }),
                            2);
    }
    return std::sqrt(squares);
}

/// Inputs in the atlas which may lie outside of it, with 95 %.
std::vector<atlas::Outside> maybe_outside(ExistingMachine const& m) {
    std::vector<atlas::Outside> all;
    for (auto const& [input, value] : inexact_of(m)) {
        atlas::SurfaceInput const& range = atlas::inputs()[input];
        if (value.mean < range.low || value.mean > range.high) continue;
        bool const is_normal = value.shape == Shape::normal;
        double const away =
            is_normal ? atlas::deviations_in_half_width * value.sd : value.high() - value.mean;
        double const low = value.mean - away, high = value.mean + away;
        double const room = 1e-9 * (range.high - range.low);  // rounding
        // A rolling friction cannot be below zero, where the atlas begins.
        double const end = range.low > 0 && low < range.low - room ? low : high;
        if (end <= range.high + room && end >= range.low) continue;
        all.push_back(
            {range.key, atlas::range_text(range.key, end, range.low, range.high) + ", which it may be"});
    }
    return all;
}

void ask_atlas(ExistingMachine const& m, MachinePrediction& found) {
    atlas::KnownNumbers const numbers = numbers_of(m);
    atlas::Place const place = atlas::place_of(numbers);
    found.outside = atlas::outside_ranges(place);
    std::ranges::move(maybe_outside(m), std::back_inserter(found.outside));
    if (m.width && m.grains.diameter)
        if (auto const why = atlas::why_too_narrow(*m.width / *m.grains.diameter))
            found.outside.push_back({"width", *why});
    found.unknown = unknown_of(m);
    if (atlas::is_far_outside(place)) return;
    found.layer = atlas::value_of(numbers);
    if (!found.layer) return;
    found.layer->half_width =
        std::hypot(found.layer->half_width, atlas::deviations_in_half_width * sd_of_inexact(m, place));
    found.mode = atlas::mode_at(place);
    theory::RollingLayer const rolling{point_of(m.drive, m.friction.mean),
                                       theory::law_of_grains(place[atlas::rolling_friction_input])};
    auto const law = theory::solve(rolling).motion;
    if (law.converged && found.point_mass)
        found.by_rolling = atlas::trend_of(law.velocity_efficiency, *found.point_mass) - *found.point_mass;
}

/// Of grains that do not roll.
void ask_point_mass(ExistingMachine const& m, MachinePrediction& found) {
    DesignModel const model = point_mass_design_model();
    DesignLayer const layer{m.drive, m.depth.value_or(1)};
    std::optional<double> depth;
    if (m.grains.diameter && m.depth) depth = *m.depth / *m.grains.diameter;
    if (auto const why = model.untested(m.drive, m.friction.mean, depth)) {
        found.outside.push_back({"point mass", *why});
        return;
    }
    double const by_friction = deviation_of(m.friction, [&](double mu) {
        auto const value = model.at(layer, mu);
        return value ? std::optional(value->efficiency) : std::nullopt;
    });
    double const sd = std::hypot(model.missed(m.drive, depth), by_friction);
    if (found.point_mass) found.layer = {*found.point_mass, atlas::deviations_in_half_width * sd};
}

}  // namespace

theory::Range known_sizes(ExistingMachine const& m) {
    auto const range = [](atlas::Input input) { return atlas::inputs()[input]; };
    theory::Range sizes{m.drive.amplitude / range(atlas::amplitude_input).high,
                        m.drive.amplitude / range(atlas::amplitude_input).low};
    if (!m.depth) return sizes;
    sizes.low = std::max(sizes.low, *m.depth / range(atlas::depth_input).high);
    sizes.high = std::min(sizes.high, *m.depth / range(atlas::depth_input).low);
    return sizes;
}

MachinePrediction predict_machine(ExistingMachine const& m) {
    constexpr double gravity = 9.81;
    auto const motion = theory::solve(point_of(m.drive, m.friction.mean));
    MachinePrediction found{m.drive.throw_number(),
                            m.drive.machine_number(gravity),
                            m.drive.trough_speed(),
                            motion.converged ? std::optional(motion.velocity_efficiency) : std::nullopt,
                            motion.mode,
                            motion.outcome};
    if (m.width && m.depth && m.bulk_density) {
        double const section = *m.width * *m.depth;
        found.flow_per_speed = Uncertain{section * m.bulk_density->mean, section * m.bulk_density->sd};
    }
    bool const rolls =
        !m.grains.rolling_friction || m.grains.rolling_friction->mean < least_friction_without_rolling;
    if (rolls)
        ask_atlas(m, found);
    else
        ask_point_mass(m, found);
    return found;
}

}  // namespace vibrotrough::learn
