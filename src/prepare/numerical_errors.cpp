#include "prepare/numerical_errors.hpp"

#include "scenario/model/softness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace vibrotrough::prepare {
namespace {

// validation/numerics/model.csv, which tests/prepare compares with these: an error is (m + t z) x, with a
// mean slope m, a deviation t from layer to layer and a normal number z of the layer. Each factor is the
// half-width over x of a new layer whose mean is not corrected.
struct SoftnessFactor {
    double throw_number;  ///< up to which it holds
    double factor;        ///< half-width over s^2
};
constexpr std::array<SoftnessFactor, 3> softness_factors{
    {{1.75, 2.17}, {2.65, 3.0}, {std::numeric_limits<double>::infinity(), 2.57}}};
constexpr double error_of_box = 0.019;  ///< of a box of 8 x 5 diameters
constexpr double error_of_step_over_rayleigh = 0.025;
constexpr double deepest_of_model = 8;  ///< diameters

// For deeper layers: validation/deep_layers, section 3, whose run.py fails when these factors are not those
// of its stored layers, and validation/whole_interval, section 1.
constexpr double factor_of_bound = 4;   ///< |error| <= 4 s^2 for all but a few layers
constexpr double factor_of_middle = 1;  ///< and s^2 for the one in the middle
constexpr double bound_of_box = 0.03;   ///< of a box of 8 x 5 diameters
constexpr double deepest_for_box = 12;  ///< diameters, from where on the error grows with the depth
constexpr double bound_of_step_over_rayleigh = 0.05;

constexpr double box_length = 8, box_width = 5;  ///< diameters

bool is_of_model(scenario::Scenario const& s) {
    return layer_height(s) <= deepest_of_model * mean_diameter(s);
}

/// Least share of the half-width wanted that is left to statistics.
double const least_share = std::sqrt(1 - largest_numerical_share * largest_numerical_share);

}  // namespace

double NumericalErrors::total() const {
    return std::hypot(softness, box, time_step);
}

NumericalErrors numerical_errors(scenario::Scenario const& s) {
    if (s.layer.block != scenario::Block::none) return {};
    double const of_step = is_of_model(s) ? error_of_step_over_rayleigh : bound_of_step_over_rayleigh;
    return {softness_error(s, s.grains.youngs_modulus.value()), box_error(s),
            of_step * s.solver.rayleigh_fraction};
}

double softness_error(scenario::Scenario const& s, double modulus) {
    double const square = std::pow(scenario::wave_number(s, modulus), 2);
    if (!is_of_model(s)) return factor_of_bound * square;
    double const throw_number = scenario::throw_number(s.trough);
    auto const holds = [&](SoftnessFactor const& one) { return throw_number < one.throw_number; };
    return std::ranges::find_if(softness_factors, holds)->factor * square;
}

bool is_soft(scenario::Scenario const& s) {
    if (s.layer.block != scenario::Block::none) return false;
    double const s_of_grains = scenario::wave_number(s, s.grains.youngs_modulus.value());
    return factor_of_middle * std::pow(s_of_grains, 2) > s.measure.half_width / 2;
}

double box_error(scenario::Scenario const& s) {
    double const d = mean_diameter(s);
    double const width = s.trough.side_wall_friction || s.trough.mesh ? box_width : s.layer.width / d;
    double const part = box_length * box_width / (s.layer.length / d * width);
    if (is_of_model(s)) return error_of_box * part;
    return bound_of_box * std::sqrt(part) * std::max(1.0, layer_height(s) / d / deepest_for_box);
}

std::string how_to_lower(NumericalErrors const& e) {
    if (e.box >= e.softness && e.box >= e.time_step)
        return fmt::format(
            "the box alone may cost {:.3f}: lengthen and widen it (layer.length, layer.width); "
            "twice the area costs twice as much per packing and needs fewer of them",
            e.box);
    if (e.softness >= e.time_step)
        return fmt::format(
            "soft grains alone may cost {:.3f}: lower solver.softness, or give stiffer ones "
            "(grains.youngs_modulus); half of the error takes 1.7 times the time",
            e.softness);
    return fmt::format(
        "the time step alone may cost {:.3f}: lower solver.rayleigh_fraction; half of it takes "
        "twice the time",
        e.time_step);
}

double whole_half_width(double statistics, NumericalErrors const& numerics) {
    return std::hypot(statistics, numerics.total());
}

namespace {

/// Half-width of the statistics with which the whole is as wide as wanted; 0 where the numerical errors are.
double most_statistics(double wanted, double numerics) {
    return std::sqrt(std::max(0.0, wanted * wanted - numerics * numerics));
}

}  // namespace

std::optional<double> left_for_statistics(double wanted, double numerics) {
    double const room = most_statistics(wanted, numerics);
    return room >= least_share * wanted ? std::optional(room) : std::nullopt;
}

bool is_narrow_enough(double statistics, scenario::Scenario const& s) {
    double const numerics = numerical_errors(s).total(), wanted = s.measure.half_width;
    return numerics <= wanted && statistics <= most_statistics(wanted, numerics);
}

scenario::MeasurementPlan statistics_plan(scenario::Scenario const& s, double half_width) {
    scenario::MeasurementPlan plan = s.measure;
    plan.half_width = left_for_statistics(half_width, numerical_errors(s).total()).value_or(half_width);
    return plan;
}

scenario::MeasurementPlan statistics_plan(scenario::Scenario const& s) {
    return statistics_plan(s, s.measure.half_width);
}

bool can_be_finished(scenario::Scenario const& s) {
    return left_for_statistics(s.measure.half_width, numerical_errors(s).total()).has_value();
}

}  // namespace vibrotrough::prepare
