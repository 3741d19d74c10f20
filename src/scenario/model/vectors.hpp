#pragma once

#include "scenario/model/trough_mesh.hpp"

#include <algorithm>
#include <cmath>

// Vectors of triangles. Internal to this module.

namespace vibrotrough::scenario {

/// a - b
inline Point minus(Point const& a, Point const& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// |a|
inline double length(Point const& a) {
    return std::hypot(a[0], a[1], a[2]);
}

/// a . b
inline double dot(Point const& a, Point const& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// a x b
inline Point cross(Point const& a, Point const& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Along the normal of a triangle, as long as twice its area.
inline Point area(Triangle const& t) {
    return cross(minus(t[1], t[0]), minus(t[2], t[0]));
}

/// The longest edge of a triangle.
inline double longest_edge(Triangle const& t) {
    return std::max({length(minus(t[1], t[0])), length(minus(t[2], t[1])), length(minus(t[0], t[2]))});
}

}  // namespace vibrotrough::scenario
