#include "learn/design_model.hpp"

#include "theory/design.hpp"
#include "theory/efficiency.hpp"
#include "theory/limits.hpp"
#include "theory/tested_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>

#include <boost/math/special_functions/erf.hpp>
#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

constexpr double least_friction = 0.01;  // a normal distribution is cut here
constexpr int value_count = 9;           // that stand for a distribution of the friction
constexpr double in_the_tail = 0.0015;   // of the distribution, on each side, in which limits are not kept
constexpr std::size_t least_draws = 100;

double normal_quantile(double p) {
    return -std::sqrt(2.0) * boost::math::erfc_inv(2 * p);
}

theory::PointMass point_of(theory::Drive const& d, double friction) {
    return {std::clamp(d.throw_number(), 1e-6, 1e4), std::tan(d.vibration_angle), std::tan(d.inclination),
            friction};
}

}  // namespace

KnownFriction normal_friction(double median, double sd) {
    if (!(median >= least_friction && sd >= 0))
        throw std::invalid_argument(
            fmt::format("a friction of {:g} +- {:g} makes no sense: it must be at least {:g}", median, sd,
                        least_friction));
    KnownFriction known{median, std::max(least_friction, median - 3 * sd), median + 3 * sd, {}, {}};
    if (sd == 0) {
        known.values.push_back(median);
        return known;
    }
    // The middles of equally likely parts, spread so that they have the standard uncertainty of the whole.
    std::vector<double> middles;
    double squares = 0;
    for (int i = 0; i < value_count; ++i) {
        middles.push_back(normal_quantile((i + 0.5) / value_count));
        squares += middles.back() * middles.back() / value_count;
    }
    for (double const middle : middles)
        known.values.push_back(std::max(least_friction, median + sd * middle / std::sqrt(squares)));
    return known;
}

KnownFriction drawn_friction(std::vector<double> const& friction, std::vector<double> const& discrepancy) {
    if (friction.size() < least_draws || (!discrepancy.empty() && discrepancy.size() != friction.size()))
        throw std::invalid_argument(
            fmt::format("the posterior has {} draws of the friction; at least {} are needed", friction.size(),
                        least_draws));
    std::vector<std::size_t> order(friction.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [&](std::size_t i) { return friction[i]; });
    if (friction[order.front()] < 1e-3)
        throw std::invalid_argument("a friction of the posterior is below 0.001");
    auto const at = [&](double share) {
        auto const last = static_cast<double>(order.size() - 1);
        return friction[order[static_cast<std::size_t>(std::lround(share * last))]];
    };
    KnownFriction known{at(0.5), at(in_the_tail), at(1 - in_the_tail), {}, {}};
    // Each value is the middle of a group of equally many neighbouring draws.
    for (std::size_t i = 0; i < std::size_t{value_count}; ++i) {
        known.values.push_back(at((static_cast<double>(i) + 0.5) / value_count));
        if (discrepancy.empty()) continue;
        std::size_t const first = i * order.size() / value_count, last = (i + 1) * order.size() / value_count;
        double squares = 0;
        for (std::size_t k = first; k < last; ++k) squares += std::pow(discrepancy[order[k]], 2);
        known.discrepancies.push_back(std::sqrt(squares / static_cast<double>(last - first)));
    }
    return known;
}

double DesignModel::missed(theory::Drive const& drive, std::optional<double> depth) const {
    if (discrepancy) return *discrepancy;
    auto const known = known_error(errors, drive.throw_number(), std::tan(drive.inclination), depth);
    return known.value_or(largest_error(errors));
}

std::optional<std::string> DesignModel::untested(theory::Drive const& drive, double friction,
                                                 std::optional<double> depth) const {
    theory::PointMass const point = point_of(drive, friction);
    if (is_rolling) {
        if (auto why = theory::outside_tested_range(point, depth)) return why;
    }
    if (outside) {
        if (auto why = outside(drive, friction, depth)) return why;
    }
    if (errors.empty() || discrepancy || uses_calibrated_discrepancy) return {};
    if (known_error(errors, point.throw_number, point.tan_inclination, depth)) return {};
    return fmt::format(
        "no simulated layer tells what {} misses at throw number {:.3g} and tan(alpha) {:.3g}{}", name,
        point.throw_number, point.tan_inclination,
        depth ? fmt::format(" in a layer {:.3g} diameters deep", *depth) : "");
}

DesignModel point_mass_design_model(std::optional<double> discrepancy) {
    auto const solver = std::make_shared<theory::EfficiencySolver>();
    DesignModel model{.name = "the point mass",
                      .discrepancy = discrepancy,
                      .errors = point_mass_errors(),
                      .is_point_mass = true};
    model.at = [solver](theory::Drive const& d, double friction) -> std::optional<ModelEfficiency> {
        double const eta = (*solver)(point_of(d, friction)).velocity_efficiency;
        if (!std::isfinite(eta)) return {};
        return ModelEfficiency{eta, 0};
    };
    // Without a discrepancy of its own it is known as far as layers were simulated.
    model.narrowed = [discrepancy](theory::DriveSpace space) {
        double const most = largest_throw_number(point_mass_errors());
        if (!discrepancy) space.max_throw_number = std::min(space.max_throw_number, most);
        return space;
    };
    model.excess = [](theory::Drive const&) { return -1.0; };
    return model;
}

DesignModel rolling_layer_design_model(theory::RollingLaw const& law, std::optional<double> discrepancy) {
    auto const solver = std::make_shared<theory::RollingLayerSolver>(law);
    DesignModel model{.name = "the rolling-layer law",
                      .discrepancy = discrepancy,
                      .errors = rolling_layer_errors(),
                      .is_rolling = true};
    model.at = [solver](theory::Drive const& d, double friction) -> std::optional<ModelEfficiency> {
        double const eta = (*solver)(point_of(d, friction)).motion.velocity_efficiency;
        if (!std::isfinite(eta)) return {};
        return ModelEfficiency{eta, 0};
    };
    model.is_rolling = true;
    model.narrowed = theory::within_tested_range;
    model.excess = [](theory::Drive const& d) { return theory::tested_excess(d); };
    return model;
}

double speed_without_slip(theory::Drive const& drive) {
    double const throw_number = drive.throw_number();
    if (throw_number <= 1) return 0;
    double low = 0, high = 1;  // cycles of flight
    for (int i = 0; i < 60; ++i) {
        double const middle = (low + high) / 2;
        (theory::throw_number_of_flight(middle) < throw_number ? low : high) = middle;
    }
    double const slope =
        std::cos(drive.inclination) / std::tan(drive.vibration_angle) - std::sin(drive.inclination);
    return 9.81 * low * low / (2 * drive.frequency) * slope;
}

double rule_of_daesung(theory::Drive const& drive) {
    return 3.81 * (60 * drive.frequency) * drive.amplitude / 60;
}

std::optional<double> factor_of_rolling_layers(double throw_number) {
    // "4 deep, free" of validation/why_theory_fails and "throw number" of validation/rolling_layer.
    constexpr std::array<double, 9> at{1.15, 1.35, 1.5, 1.6, 1.7, 1.9, 2.0, 2.15, 2.25};
    constexpr std::array<double, 9> layer{.220, .368, .501, .625, .685, .786, .827, .869, .894};
    if (throw_number < 1.2 || throw_number > 2.3) return {};
    std::size_t i = 1;
    while (i + 1 < at.size() && at[i] < throw_number) ++i;
    double const share = std::min(1.0, (throw_number - at[i - 1]) / (at[i] - at[i - 1]));
    double const efficiency = layer[i - 1] + share * (layer[i] - layer[i - 1]);
    return efficiency / theory::solve(theory::PointMass{throw_number, 0.5, 0, 0.23}).velocity_efficiency;
}

}  // namespace vibrotrough::learn
