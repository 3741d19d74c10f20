#include "learn/machine_prediction.hpp"

#include "atlas/tables.hpp"
#include "atlas/unknown.hpp"
#include "learn/machine_keys.hpp"
#include "theory/rolling_layer.hpp"

#include <algorithm>
#include <cmath>

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

/// Standard deviation of the efficiency by what is known of some inputs, but not exactly.
double sd_of_inexact(ExistingMachine const& m, atlas::Place const& place) {
    double squares = 0;
    auto const add = [&](atlas::Input input, std::optional<Uncertain> const& known) {
        if (!known || known->sd <= 0) return;
        atlas::SurfaceInput const& range = atlas::inputs()[input];
        atlas::Place other = place;
        squares += std::pow(deviation_of(*known,
                                         [&](double value) {
                                             other[input] = std::clamp(value, range.low, range.high);
                                             return atlas::efficiency_at(other);
                                         }),
                            2);
    };
    add(atlas::friction_input, m.friction);
    add(atlas::rolling_friction_input, m.grains.rolling_friction);
    add(atlas::grain_friction_input, m.grains.friction);
    return std::sqrt(squares);
}

void ask_atlas(ExistingMachine const& m, MachinePrediction& found) {
    atlas::KnownNumbers const numbers = numbers_of(m);
    atlas::Place const place = atlas::PartlyKnown::place_of(numbers);
    found.outside = atlas::outside_ranges(place);
    found.unknown = unknown_of(m);
    if (atlas::is_far_outside(place)) return;
    atlas::PartlyKnown known;
    known.prepare(numbers);
    found.layer = known(numbers);
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
    sizes.high = std::max(sizes.low, std::min(sizes.high, *m.depth / range(atlas::depth_input).low));
    return sizes;
}

MachinePrediction predict_machine(ExistingMachine const& m) {
    constexpr double gravity = 9.81;
    auto const motion = theory::solve(point_of(m.drive, m.friction.mean));
    MachinePrediction found{m.drive.throw_number(), m.drive.machine_number(gravity), m.drive.trough_speed(),
                            motion.converged ? std::optional(motion.velocity_efficiency) : std::nullopt,
                            motion.mode};
    if (m.width && m.depth && m.bulk_density) found.flow_per_speed = *m.bulk_density * *m.width * *m.depth;
    bool const rolls =
        !m.grains.rolling_friction || m.grains.rolling_friction->mean < least_friction_without_rolling;
    if (rolls)
        ask_atlas(m, found);
    else
        ask_point_mass(m, found);
    return found;
}

}  // namespace vibrotrough::learn
