#pragma once

#include "scenario/model/grains.hpp"

#include <array>
#include <memory>
#include <vector>

namespace vibrotrough::prepare {

/// A rigid body of overlapping spheres in the axes of its shape, with the centre of mass at the origin. Its
/// mass is that of the volume that the spheres cover together: overlaps count once.
struct Clump {
    std::vector<scenario::Sphere> spheres;  ///< m
    double volume;                          ///< m^3
    std::array<double, 6> inertia;          ///< m^5, tensor divided by density: xx, xy, xz, yy, yz, zz
    double bounding_radius;  ///< m, of the smallest sphere around the origin that holds all spheres
    double smallest_radius;  ///< m, radius of the smallest of its spheres
};

/// The clump of the grains' shape that has the volume of a sphere of the grains' diameter. Volume and inertia
/// are integrated over a grid of 400 x 400 lines parallel to x, exactly along each line. The error is 1e-4
/// for the built-in shapes.
std::shared_ptr<Clump const> make_clump(scenario::Grains const& grains);

/// A plate of three by three spheres of this diameter (m), whose centres are two diameters apart.
std::shared_ptr<Clump const> make_plate(double diameter);

}  // namespace vibrotrough::prepare
