#pragma once

#include "scenario/model/scenario.hpp"

#include <optional>

/// @file
/// What is known beforehand of a case's numerical errors, and what they leave of the interval that a campaign
/// file asks for. validation/whole_interval judges these bounds on layers that were not used to find them.

namespace vibrotrough::prepare {

/// Bounds, at 95 %, of the errors of the velocity efficiency that a case's numerical settings cause. The flat
/// meshes of floor and walls are exact and have no part in them. A rigid block has none of these errors.
struct NumericalErrors {
    double softness = 0;  ///< soft grains: softness_bound()
    double box = 0;       ///< the periodic box: box_bound()
    /// Of the engine: 0.01 for the usual 0.2 Rayleigh times, in proportion to solver.rayleigh_fraction. No
    /// effect is seen, and this is how well that is known.
    double time_step = 0;

    /// All together: the root of the sum of squares, because the settings act independently of each other.
    double total() const;
};

/// The bounds of a case. Its Young's modulus must be known.
NumericalErrors numerical_errors(scenario::Scenario const& scenario);

/// Bound of the error that a periodic box of the length L and the width W causes in a layer of the depth h:
/// 0.03 sqrt(40 d^2 / (L W)), times h / (12 d) for layers more than 12 diameters deep
/// (validation/whole_interval, section 1). Between side walls the width is part of the problem, and 5 d takes
/// its place.
double box_bound(scenario::Scenario const& scenario);

/// The half-width of statistics and numerics together, which are independent of each other: the root of the
/// sum of squares.
double whole_half_width(double statistics, NumericalErrors const& numerics);

/// The largest share of a half-width wanted that the numerical errors may have, sqrt(3) / 2, so that half of
/// it is left to statistics: 1 = 3/4 + 1/4.
inline constexpr double largest_numerical_share = 0.8660254037844386;

/// What numerical errors leave of a half-width to statistics, sqrt(wanted^2 - numerics^2); nothing where this
/// is less than half of it.
/// @param numerics  NumericalErrors::total(), or the numerical error that `convergence` found
std::optional<double> left_for_statistics(double wanted, double numerics);

/// The measurement plan whose half_width is what the numerical errors leave to statistics, so that the whole
/// is as narrow as the case asks. Where they leave less than half of it, the case cannot be finished, and its
/// statistics get all of the half-width, as for a study of differences, in which the errors cancel.
/// @param half_width  wanted of the whole, in place of measure.half_width
scenario::MeasurementPlan statistics_plan(scenario::Scenario const& scenario, double half_width);

/// The same for measure.half_width.
scenario::MeasurementPlan statistics_plan(scenario::Scenario const& scenario);

/// Whether statistics of this half-width make the whole interval as narrow as measure.half_width asks, by the
/// numbers of statistics_plan(): what decides both when a case gets no more packings and how it ends.
bool is_narrow_enough(double statistics, scenario::Scenario const& scenario);

/// Whether the numerical errors leave room for statistics, so that the case can be finished.
bool can_be_finished(scenario::Scenario const& scenario);

}  // namespace vibrotrough::prepare
