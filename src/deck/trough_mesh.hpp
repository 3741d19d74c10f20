#pragma once

#include <string>

namespace vibrotrough::deck {

/// An STL of a flat floor 0 <= x <= length, 0 <= y <= width, z = 0, with its outermost nodes exactly on the
/// ends and elements as near to `edge` long and to isosceles as fits: the engine stops at long thin
/// triangles.
std::string flat_trough_stl(double length, double width, double edge);

/// An STL of a side wall 0 <= x <= length, 0 <= z <= height in the plane y, in the same way.
std::string side_wall_stl(double length, double height, double y, double edge);

}  // namespace vibrotrough::deck
