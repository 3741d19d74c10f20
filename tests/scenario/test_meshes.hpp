#pragma once

#include "scenario/model/trough_mesh.hpp"

#include <vector>

namespace vibrotrough::scenario {

/// Two triangles of a rectangle with these corners, in order.
inline void add_rectangle(std::vector<Triangle>& mesh, Point a, Point b, Point c, Point d) {
    mesh.push_back({a, b, c});
    mesh.push_back({a, c, d});
}

/// A V of two planes with 45 degrees, 36 mm long and 18 mm wide, so that its sides are 9 mm high; in mm and
/// away from 0.
inline std::vector<Triangle> short_vee() {
    std::vector<Triangle> mesh;
    add_rectangle(mesh, {5, -9, 9}, {41, -9, 9}, {41, 0, 0}, {5, 0, 0});
    add_rectangle(mesh, {5, 0, 0}, {41, 0, 0}, {41, 9, 9}, {5, 9, 9});
    return mesh;
}

}  // namespace vibrotrough::scenario
