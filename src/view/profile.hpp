#pragma once

#include "view/dump_reader.hpp"

#include <vector>

namespace vibrotrough::view {

/// The layer in slabs parallel to the trough, from its surface upwards.
struct Profile {
    std::vector<double> height;          ///< m, middle of each slab above the trough's surface
    std::vector<double> solid_fraction;  ///< volume of grains over volume of the slab
    std::vector<double> velocity;        ///< m/s along x; mean over that volume; NaN in an empty slab
};

/// Slabs of half a mean diameter; thicker when the layer reaches above 400 of them. A grain counts in each
/// slab with the volume of its slice, and what is pressed into the trough counts in the lowest.
/// @param surface   m, height of the trough's surface
/// @param area      m^2, of the trough under the layer
/// @param velocity  m/s, x y z of each grain
/// @returns no slab when there is no grain
Profile profile_of(GrainFrame const& frame, std::vector<float> const& velocity, double surface, double area);

}  // namespace vibrotrough::view
