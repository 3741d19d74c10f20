#pragma once

#include "scenario/model/scenario.hpp"

#include <optional>
#include <string>

/// @file
/// What is known beforehand of a case's numerical errors, and what they leave of the interval that a campaign
/// file asks for. validation/whole_interval judges these bounds on layers that were not used to find them.

namespace vibrotrough::prepare {

/// Half-widths, at 95 %, of the errors of the velocity efficiency that a case's numerical settings cause. The
/// flat meshes of floor and walls are exact and have no part in them. A rigid block has none of these errors.
///
/// Layers of up to 8 diameters have those of a new layer by the model of validation/numerics, Student's
/// quantile times the root of the squares of scatter from layer to layer, mean, and what is not known of the
/// mean. Deeper layers have bounds that nearly all layers keep: validation/deep_layers and
/// validation/whole_interval, section 1.
struct NumericalErrors {
    double softness = 0;   ///< soft grains: softness_error()
    double box = 0;        ///< the periodic box: box_error()
    double time_step = 0;  ///< of the engine: in proportion to the time step over the Rayleigh time

    /// All together: the root of the sum of squares, because the settings act independently of each other.
    double total() const;
};

/// The errors of a case. Its Young's modulus must be known.
NumericalErrors numerical_errors(scenario::Scenario const& scenario);

/// Of a periodic box of the length L and the width W, in proportion to d^2 / (L W): 0.019 for 8 x 5
/// diameters. More than 8 diameters deep, 0.03 sqrt(40 d^2 / (L W)), times h / (12 d) from 12 diameters on.
/// Between side walls the width is part of the problem, and 5 d takes its place.
double box_error(scenario::Scenario const& scenario);

/// Of soft grains of this modulus (Pa), in proportion to the square of scenario::wave_number(): 2.2 to 3.0
/// s^2 by the throw number, 4 s^2 for layers of more than 8 diameters.
double softness_error(scenario::Scenario const& scenario, double modulus);

/// What would lower the largest of the errors of a case, for people: the key, and what that costs.
std::string how_to_lower(NumericalErrors const& errors);

/// Whether the grains of a case are too soft for what it asks: even the error of the layer in the middle,
/// s^2, is more than half of measure.half_width. The modulus must be known.
bool is_soft(scenario::Scenario const& scenario);

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
