#pragma once

#include "view/dump_reader.hpp"

#include <vector>

namespace vibrotrough::view {

/// The layer divided into slabs parallel to the trough, from the trough's surface upwards.
struct Profile {
    std::vector<double> height;  ///< m, middle of each slab above the trough's surface
    /// Volume of the grains in the slab divided by the volume of the slab.
    std::vector<double> solid_fraction;
    std::vector<double> velocity;  ///< m/s along x; volume-weighted mean; NaN in an empty slab
};

/// Computes the profile in slabs of half a mean diameter, or thicker if that would need more than 400 slabs.
/// A grain contributes to each slab the volume of its part in the slab; the parts below the surface of the
/// trough are added to the lowest slab.
/// @param surface   m, height of the trough's surface
/// @param area      m^2, of the trough under the layer
/// @param velocity  m/s, x y z of each grain
/// @returns a profile without slabs if there are no grains
Profile profile_of(GrainFrame const& frame, std::vector<float> const& velocity, double surface, double area);

}  // namespace vibrotrough::view
