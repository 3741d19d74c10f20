#pragma once

#include "measure/layer_profiles.hpp"

#include <optional>
#include <span>
#include <vector>

namespace vibrotrough::measure {

/// The mass flow of a layer over its depth, per area of a section that moves with the trough: mean over the
/// cycle of density times solid fraction times velocity relative to the trough. Its integral over the height
/// is the layer's mass per area of trough times its conveying speed.
struct MassFlow {
    std::vector<double> height;  ///< m, middle of each slab above the surface of the trough
    std::vector<double> flow;    ///< kg/(m^2 s), mean over the packings
    /// kg/(m^2 s), half-width of Student's interval over the packings; NaN with one packing.
    std::vector<double> half_width;
};

/// The mass flow from the profiles of packings. The bins of the profiles are fixed to the ground, so that
/// they are at other heights above the trough at each phase. What is in a bin is taken as spread evenly over
/// it, and is put into slabs of the same thickness that are fixed to the trough; what is below its surface
/// (as far as grains overlap it) counts to the lowest slab. All phases count the same, because they are
/// evenly spaced.
/// @param packings    profiles of packings with the same bins; those without rows do not count
/// @param density     kg/m^3, of the grains
/// @param confidence  level of the intervals
/// @returns no slabs without profiles
MassFlow mass_flow(std::span<Profiles const* const> packings, double density, double confidence);

/// Half-width of Student's interval of a mean: t s / sqrt(n) with n - 1 degrees of freedom; none for fewer
/// than two values.
std::optional<double> student_half_width(std::span<double const> values, double confidence);

}  // namespace vibrotrough::measure
