#include "atlas/value.hpp"

#include "atlas/tables.hpp"
#include "theory/point_mass.hpp"
#include "theory/rolling_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::atlas {
namespace {

Surface const& surface() {
    static Surface const fitted(surface_inputs(), with_trends(read_layers(layers_table, "layers.csv")),
                                read_draws(draws_table, "draws.csv", surface_inputs()));
    return fitted;
}

/// Layers have a friction of so much more than their slope: others slide down ever faster.
constexpr double least_grip = 0.03;
/// Layers that are deeper than this, in diameters, have slopes and amplitudes of a narrower range.
constexpr double deepest_of_wider = 6, steepest_of_deep = 0.1, smallest_of_deep = 0.5;

/// The trend of the atlas, as trend_at() gives it.
std::optional<double> solved_trend(theory::PointMass const& point, double rolling_friction) {
    // A design asks for many frictions at one throw number, for which the solver keeps the normal motion.
    thread_local std::optional<std::pair<double, theory::RollingLayerSolver>> last;
    if (!last || last->first != rolling_friction)
        last.emplace(rolling_friction, theory::law_of_grains(rolling_friction));
    auto const motion = last->second(point).motion, sliding = theory::solve(point);
    for (theory::Motion const& one : {motion, sliding})
        if (!one.converged && one.outcome != theory::Outcome::unsettled) return {};
    return trend_of(motion.velocity_efficiency, sliding.velocity_efficiency);
}

/// The trend of the atlas at a place; nothing when a rolling layer or a point mass has no mean speed there.
/// Places that differ in other inputs alone often follow each other, and have the same.
std::optional<double> trend_at(Place const& place) {
    theory::PointMass const point{place[throw_number_input], place[tan_vibration_input],
                                  place[tan_inclination_input], place[friction_input]};
    std::array const key{point.throw_number, point.tan_vibration_angle, point.tan_inclination, point.friction,
                         place[rolling_friction_input]};
    thread_local std::optional<std::pair<std::array<double, 5>, std::optional<double>>> last;
    if (!last || last->first != key) last.emplace(key, solved_trend(point, key.back()));
    return last->second;
}

/// The interval of a layer: that of the surface, what layers scatter about it, and their numerical errors.
SurfaceValue with_scatter(SurfaceValue const& value, Place const& place) {
    static double const scatter = scatter_half_width(surface());
    return {value.efficiency, std::hypot(value.half_width, scatter, numerical_error(place[depth_input]))};
}

/// Of the efficiency at a place, when an input lies anywhere in its range: by the three points of Gauss and
/// Legendre (M. Abramowitz and I.A. Stegun, Handbook of Mathematical Functions, 25.4.30).
double variance_by(Input input, Place place) {
    double known = 0, sum = 0, squares = 0;
    for (auto const& [weight, away] : {std::pair{5., -std::sqrt(0.6)}, {8., 0.}, {5., std::sqrt(0.6)}}) {
        place[input] = inputs()[input].value_at((1 + away) / 2);
        auto const efficiency = efficiency_at(place);
        if (!efficiency) continue;
        known += weight;
        sum += weight * *efficiency;
        squares += weight * *efficiency * *efficiency;
    }
    return known > 0 ? std::max(0.0, squares / known - sum * sum / (known * known)) : 0;
}

}  // namespace

std::string range_text(std::string_view name, double value, double low, double high) {
    return fmt::format("{} {:.3g} (the atlas has {:g} to {:g})", name, value, low, high);
}

std::optional<std::string> why_too_narrow(double width) {
    constexpr double least = 20;
    if (width >= least) return {};
    return fmt::format("side walls {:.3g} diameters apart (at least {:g})", width, least);
}

std::vector<Outside> outside_together(Place const& place) {
    std::vector<Outside> all;
    auto const narrow = [&](Input input, double low, double high) {
        if (place[input] < low || place[input] > high)
            all.push_back({inputs()[input].key, range_text(inputs()[input].key, place[input], low, high)});
    };
    double const slope = std::abs(place[tan_inclination_input]);
    narrow(friction_input, slope + least_grip, inputs()[friction_input].high);
    if (slope > steepest_of_deep || place[amplitude_input] < smallest_of_deep)
        narrow(depth_input, inputs()[depth_input].low, deepest_of_wider);
    return all;
}

std::vector<Outside> outside_ranges(Place const& place) {
    constexpr double rounding = 1e-9;  // of the width of a range
    std::vector<Outside> all;
    for (std::size_t k = 0; k < place.size(); ++k) {
        SurfaceInput const& input = inputs()[k];
        double const room = rounding * (input.high - input.low);
        if (place[k] < input.low - room || place[k] > input.high + room)
            all.push_back({input.key, range_text(input.key, place[k], input.low, input.high)});
    }
    if (all.empty()) all = outside_together(place);
    return all;
}

bool is_far_outside(Place const& place) {
    for (std::size_t k = 0; k < place.size(); ++k) {
        double const share = inputs()[k].share_of(place[k]);
        if (!(share >= -farthest && share <= 1 + farthest)) return true;
    }
    return false;
}

Place within_ranges(Place place) {
    for (std::size_t k = 0; k < place.size(); ++k)
        place[k] = std::clamp(place[k], inputs()[k].low, inputs()[k].high);
    return place;
}

int simulated_layers() {
    return static_cast<int>(surface().points().size());
}

double numerical_error(double depth) {
    static double const bound = read_numerical_bound(layers_table, "layers.csv");
    constexpr double from = 6;
    double const share = std::clamp(std::log(depth / from) / std::log(deepest_estimated / from), 0., 1.);
    return std::lerp(common_numerical_error, bound, share);
}

std::vector<double> error_lengths() {
    auto const draws = read_draws(law_draws_table, "draws_law.csv");
    std::vector<double> lengths;
    for (std::size_t k = 0; k < inputs().size(); ++k) {
        std::vector<double> all;
        for (inference::Hyperparameters const& draw : draws)
            all.push_back(draw.lengths(static_cast<Eigen::Index>(k)));
        std::sort(all.begin(), all.end());
        lengths.push_back(all[all.size() / 2]);
    }
    return lengths;
}

double distance_between(Place const& one, Place const& other) {
    static std::vector<double> const lengths = error_lengths();
    double squares = 0;
    for (std::size_t k = 0; k < lengths.size(); ++k) {
        SurfaceInput const& input = inputs()[k];
        squares += std::pow((input.share_of(one[k]) - input.share_of(other[k])) / lengths[k], 2);
    }
    return std::sqrt(squares);
}

std::optional<double> efficiency_at(Place const& place) {
    auto const trend = trend_at(place);
    if (!trend) return {};
    return surface().efficiency_at(with_trend(place, *trend), *trend);
}

std::optional<double> near_efficiency_at(Place const& place) {
    auto const trend = trend_at(place);
    if (!trend) return {};
    return surface().near_efficiency_at(with_trend(place, *trend), *trend);
}

std::optional<SurfaceValue> difference_between(Place const& place, Place const& other) {
    auto const trend = trend_at(place), trend_there = trend_at(other);
    if (!trend || !trend_there) return {};
    return surface().difference(with_trend(place, *trend), *trend, with_trend(other, *trend_there),
                                *trend_there);
}

std::optional<SurfaceValue> value_at(Place const& place) {
    auto const trend = trend_at(place);
    if (!trend) return {};
    return with_scatter(surface().at(with_trend(place, *trend), *trend), place);
}

std::optional<SurfaceValue> value_of(KnownNumbers const& numbers) {
    Place const place = place_of(numbers);
    auto value = value_at(place);
    if (!value) return {};
    double variance = 0;
    for (std::size_t input = 0; input < numbers.size(); ++input)
        if (!numbers[input]) variance += variance_by(static_cast<Input>(input), place);
    value->half_width = std::hypot(value->half_width, deviations_in_half_width * std::sqrt(variance));
    return value;
}

std::optional<SurfaceValue> near_value_at(Place const& place) {
    auto const trend = trend_at(place);
    if (!trend) return {};
    return with_scatter(surface().nearly_at(with_trend(place, *trend), *trend), place);
}

}  // namespace vibrotrough::atlas
