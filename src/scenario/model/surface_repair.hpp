#pragma once

#include "scenario/model/trough_mesh.hpp"

#include <string>
#include <vector>

/// @file
/// What is harmless in a surface of triangles is mended, and needles are divided into stouter triangles.

namespace vibrotrough::scenario {

/// Triangles with what is known of each.
struct Surface {
    std::vector<Triangle> triangles;   ///< their corners
    std::vector<std::size_t> part_of;  ///< of each triangle the index of its solid
    std::vector<std::size_t> numbers;  ///< of each triangle its number in the file, from 1
};

/// Makes a surface such as the engine takes. Corners closer to each other than `tolerance` become one;
/// triangles that are less high than it and copies of others are left out; where a corner lies in the edge of
/// a triangle at a border, this triangle is divided, because the engine would find a second contact at the
/// edge.
/// @param tolerance  in the unit of the file
/// @param origin     the place in the file that is 0 in the surface, for messages
/// @return a sentence for each kind of change, with the number of places and the first one
std::vector<std::string> mend(Surface& surface, double tolerance, Point const& origin);

/// The smallest angle of a triangle, rad.
double smallest_angle(Triangle const& triangle);

/// Divides long borders and folds of a surface in the middle until none is longer than `longest`, and turns
/// edges inside its plane parts where this makes the smallest angle larger (Lawson's flips): a strip of two
/// needles becomes a row of stout triangles. The surface stays the same to a ten-thousandth of `longest`.
std::vector<Triangle> without_needles(std::vector<Triangle> const& triangles, double longest);

}  // namespace vibrotrough::scenario
