#include "prepare/numerical_errors.hpp"

#include "prepare/softness.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::prepare {
namespace {

// validation/whole_interval, section 1. tests/prepare compares them with the stored tables they come from.
constexpr double error_of_box = 0.03;            ///< of a box of 8 x 5 diameters
constexpr double box_length = 8, box_width = 5;  ///< in diameters
constexpr double deepest_for_box = 12;           ///< diameters, from where on the error grows with the depth
constexpr double error_of_time_step = 0.01;      ///< of a step of 0.2 Rayleigh times
constexpr double usual_rayleigh_fraction = 0.2;

/// Least share of the half-width wanted that is left to statistics.
double const least_share = std::sqrt(1 - largest_numerical_share * largest_numerical_share);

}  // namespace

double NumericalErrors::total() const {
    return std::hypot(softness, box, time_step);
}

NumericalErrors numerical_errors(scenario::Scenario const& s) {
    if (s.layer.block != scenario::Block::none) return {};
    return {softness_bound(s, s.grains.youngs_modulus.value()), box_bound(s),
            error_of_time_step * s.solver.rayleigh_fraction / usual_rayleigh_fraction};
}

double box_bound(scenario::Scenario const& s) {
    double const d = mean_diameter(s);
    double const width = s.trough.side_wall_friction || s.trough.mesh ? box_width : s.layer.width / d;
    double const area = s.layer.length / d * width;
    double const depth = layer_height(s) / d;
    return error_of_box * std::sqrt(box_length * box_width / area) * std::max(1.0, depth / deepest_for_box);
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
