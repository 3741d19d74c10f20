#pragma once

#include "prepare/prepared_case.hpp"

#include <array>
#include <string>
#include <vector>

namespace vibrotrough::deck {

/// The names of the meshes of walls, of which a deck has those that its trough has: left and right, at the
/// back and below the edge.
inline constexpr std::array wall_files{"left.stl", "right.stl", "back.stl", "end.stl"};

/// The STL text of a flat floor 0 <= x <= length, 0 <= y <= width, z = 0 (m). Its outermost nodes are exactly
/// on the ends. The triangles have legs of about `edge` (m) and nearly equal length, because the engine
/// refuses long thin triangles.
std::string flat_trough_stl(double length, double width, double edge);

/// The mesh of a case with triangles that are not much larger than grains: what has the trough's friction,
/// and then each of prepared.domain.parts. Upright sides are continued to the top of the box, by what their
/// upper edge belongs to, so that grains that are poured in or thrown up do not leave it.
/// @pre prepared.domain.has_mesh()
std::vector<std::vector<scenario::Triangle>> own_trough(prepare::PreparedCase const& prepared);

/// The smallest angle of all triangles of own_trough(), degrees.
double smallest_angle_of_mesh(prepare::PreparedCase const& prepared);

/// Degrees: below it the engine wants the word curvature_tolerant.
inline constexpr double least_angle_of_engine = 0.26;
/// Degrees: below it the engine refuses a triangle.
inline constexpr double hard_angle_of_engine = 0.06;

/// The name of a part's mesh in the engine.
std::string part_mesh(std::size_t part);
/// The name of the file of that mesh.
std::string part_file(std::size_t part);

/// The STL text of a flat sheet of the same size with square holes, in `along` columns and `across` rows.
/// Bars of half their width are at its ends, so that the ends of the periodic box run along the middle of
/// bars. The legs of the triangles are about twice as long as the bars are wide at most.
/// @param opening  m, side of the holes
/// @param plate    m, length of a closed part before the first bars
std::string screen_stl(double length, double width, double opening, int along, int across, double plate = 0);

/// The number of triangles of such a screen.
int screen_triangles(double length, double width, double opening, int along, int across, double plate);

/// The STL text of a side wall 0 <= x <= length, 0 <= z <= height at this y (m), with triangles of the same
/// kind.
std::string side_wall_stl(double length, double height, double y, double edge);

/// The STL text of a wall across the trough at this x, 0 <= y <= width, bottom <= z <= top (m), with
/// triangles of the same kind.
std::string cross_wall_stl(double width, double bottom, double top, double x, double edge);

}  // namespace vibrotrough::deck
