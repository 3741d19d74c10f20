#pragma once

#include "scenario/model/grains.hpp"

#include <array>
#include <vector>

namespace vibrotrough::deck {

/// A rigid body of overlapping spheres, in the axes of its shape, the centre of mass at 0. Its mass is that
/// of the volume that the spheres cover: overlaps count once.
struct Clump {
    std::vector<scenario::Sphere> spheres;  ///< m
    double volume;                          ///< m^3
    std::array<double, 6> inertia;          ///< m^5, per density: xx, xy, xz, yy, yz, zz
    double bounding_radius;                 ///< m, of the smallest sphere around 0 that holds all
    double smallest_radius;                 ///< m, of its spheres
};

/// The clump of a grain's shape with the volume of a sphere of the grain's diameter. Volume and inertia are
/// integrated over a grid of 400 x 400 lines along x, exactly along each: to 1e-4 for the shapes here.
Clump make_clump(scenario::Grains const& grains);

/// A plate of three by three spheres of this diameter, two diameters apart.
Clump make_plate(double diameter);

}  // namespace vibrotrough::deck
