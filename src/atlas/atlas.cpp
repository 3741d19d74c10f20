#include "atlas/atlas.hpp"

#include "atlas/tables.hpp"
#include "theory/point_mass.hpp"
#include "theory/rolling_layer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::atlas {
namespace {

/// Side walls further apart than this, in diameters, do not slow the layer down.
constexpr double least_width = 20;
/// The atlas' layers have a spread of 0.1; others may be this far from it.
constexpr double least_spread = 0.05, most_spread = 0.2;
/// Grain and trough have the same restitution in the atlas; others may be so far apart.
constexpr double most_restitution_difference = 0.2;
/// Further beyond a range than this, in widths of it, the atlas says nothing at all.
constexpr double farthest = 0.25;

Surface const& surface() {
    static Surface const fitted(inputs(), read_layers(layers_table, "layers.csv"),
                                read_draws(draws_table, "draws.csv"));
    return fitted;
}

/// Half-width of what the layers scatter about the surface beyond their own intervals.
double scatter_half_width() {
    static double const width = [] {
        auto const draws = surface().draws();
        double variance = 0;
        for (inference::Hyperparameters const& draw : draws)
            variance += draw.extra_noise * draw.extra_noise / static_cast<double>(draws.size());
        return deviations_in_half_width * std::sqrt(variance);
    }();
    return width;
}

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
    add(s.engine.contact == scenario::ContactModel::hooke, "engine.contact", "contacts other than Hertz'");
    add(s.engine.cohesion > 0, "engine.cohesion", "cohesion");
    add(s.engine.extra != nullptr || s.engine.templates != nullptr, "engine",
        "commands of the engine of your own");
    add(s.trough.side_wall_friction && s.layer.width < least_width * diameter, "trough.side_wall_friction",
        fmt::format("side walls {:.3g} diameters apart (at least {:g})", s.layer.width / diameter,
                    least_width));
    add(p.domain.has_mesh(), "trough.mesh", "a trough of your own");
    add(p.domain.open.has_value(), "feed", "an open trough");
    add(p.domain.screen.has_value(), "screen", "a screen");
    add(!p.stages.empty(), "stages", "a drive in stages");
    add(s.trough.waveform || !s.trough.harmonics.empty() || s.trough.along_phase != 0, "trough",
        "a drive that is not one sinusoid along a line");
    return all;
}

/// The place of a layer in the atlas, in the order of inputs().
Place place_of(prepare::PreparedCase const& p) {
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

/// The trend of the atlas at a place; nothing when a rolling layer or a point mass has no mean speed there.
std::optional<double> trend_at(Place const& place) {
    theory::PointMass const point{place[throw_number_input], place[tan_vibration_input],
                                  place[tan_inclination_input], place[friction_input]};
    // A design asks for many frictions at one throw number, for which the solver keeps the normal motion.
    thread_local std::optional<std::pair<double, theory::RollingLayerSolver>> last;
    theory::RollingLaw law;
    law.dry_torque += place[rolling_friction_input];
    if (!last || last->first != law.dry_torque) last.emplace(law.dry_torque, theory::RollingLayerSolver(law));
    auto const motion = last->second(point).motion, sliding = theory::solve(point);
    for (theory::Motion const& one : {motion, sliding})
        if (!one.converged && one.outcome != theory::Outcome::unsettled) return {};
    return trend_of(motion.velocity_efficiency, sliding.velocity_efficiency);
}

std::string range_text(std::string_view name, double value, double low, double high) {
    return fmt::format("{} {:.3g} (the atlas has {:g} to {:g})", name, value, low, high);
}

std::vector<Outside> out_of_range(prepare::PreparedCase const& p, Place const& place) {
    constexpr double rounding = 1e-9;  // of the width of a range
    std::vector<Outside> all;
    for (std::size_t k = 0; k < place.size(); ++k) {
        auto const& [name, low, high] = inputs()[k];
        double const room = rounding * (high - low);
        if (place[k] < low - room || place[k] > high + room)
            all.push_back({name, range_text(name, place[k], low, high)});
    }
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

}  // namespace

int simulated_layers() {
    return static_cast<int>(surface().points().size());
}

double numerical_error() {
    static double const mean = read_numerical_error(layers_table, "layers.csv");
    return mean;
}

Place error_lengths() {
    auto const draws = surface().draws();
    Place lengths;
    for (std::size_t k = 0; k < inputs().size(); ++k) {
        std::vector<double> all;
        for (inference::Hyperparameters const& draw : draws)
            all.push_back(draw.lengths(static_cast<Eigen::Index>(k)));
        std::ranges::sort(all);
        lengths.push_back(all[all.size() / 2] * (inputs()[k].high - inputs()[k].low));
    }
    return lengths;
}

std::optional<SurfaceValue> value_at(Place const& place) {
    auto const trend = trend_at(place);
    if (!trend) return {};
    SurfaceValue const value = surface().at(place, *trend);
    return SurfaceValue{value.efficiency,
                        std::hypot(value.half_width, scatter_half_width(), numerical_error())};
}

Answer predict(prepare::PreparedCase const& prepared) {
    Answer answer{{}, {}, of_another_kind(prepared)};
    if (!answer.is_inside()) return answer;
    Place const place = place_of(prepared);
    answer.outside = out_of_range(prepared, place);
    for (std::size_t k = 0; k < place.size(); ++k) {
        auto const& [name, low, high] = inputs()[k];
        if (std::max(low - place[k], place[k] - high) > farthest * (high - low)) return answer;
    }
    auto const value = value_at(place);
    if (!value) {
        answer.outside.push_back({"theory", "a point mass or rolling layer without a mean speed"});
        return answer;
    }
    answer.efficiency = value->efficiency;
    answer.half_width = value->half_width;
    return answer;
}

}  // namespace vibrotrough::atlas
