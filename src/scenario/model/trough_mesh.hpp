#pragma once

#include "scenario/model/grains.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

/// @file
/// A trough of any shape: a surface of triangles from an STL file in place of the flat floor.

namespace vibrotrough::scenario {

/// A point or a direction: x along the trough, y across, z normal to it.
using Point = std::array<double, 3>;
/// The corners of a triangle.
using Triangle = std::array<Point, 3>;

/// The unit of length of an STL file, which does not say it.
enum class MeshUnit {
    mm,    ///< millimetres
    m,     ///< metres
    cm,    ///< centimetres
    inch,  ///< inches of 25.4 mm
};

/// The word of the campaign file.
std::string_view name_of(MeshUnit unit);

/// Metres in a unit of a mesh.
double metres_in(MeshUnit unit);

/// A layer that rests in a trough: means over the cross-sections.
struct LevelLayer {
    double depth;   ///< its surface above the lowest point of a cross-section
    double height;  ///< its surface above the lowest point of the trough
};

/// A mesh as read from a file, moved so that its box begins at 0 in every direction, and mended (see mend()
/// in surface_repair.hpp). Corners closer to each other, or to its ends along and across, than 1e-5 of the
/// diagonal of its box are put exactly there. Cases that name the same file share it. All
/// lengths are in the unit of the file.
struct TroughMesh {
    std::vector<NamedFile> files;     ///< names and contents; a binary file is kept as text
    std::vector<Triangle> triangles;  ///< the surface
    Point extent;                     ///< of its box: length, width and height
    /// Height of the surface on a grid in plan, row by row along the trough: the uppermost triangle that is
    /// not vertical. NaN where there is none.
    std::vector<double> heights;
    double mismatch_along;  ///< largest difference in height between its two ends, which a periodic box joins
    double mismatch_across;              ///< the same between its two sides
    std::array<bool, 2> has_end_plates;  ///< whether upright plates stand in its first and its last end
    bool has_upright_sides;  ///< whether upright walls close both of its sides, from the surface to its top
    double floor_top;        ///< height of the highest node of a triangle that does not lie in a side
    double area;             ///< of all triangles
    /// Names of the solids of a text file that have triangles, in its order, with '_' for all but letters,
    /// digits, '.' and '-'; a binary file is one. Of several files each is one, with the name of the file.
    std::vector<std::string> parts;
    std::vector<std::size_t> part_of;       ///< of each triangle the index in `parts`
    std::vector<std::size_t> numbers = {};  ///< of each triangle its number in the file, from 1
    std::vector<std::string> repairs = {};  ///< what was mended or left out, a sentence each; see mend()

    /// The names of the files, for messages.
    std::string names() const;
    /// The first place of the grid (x, y) without a surface; none when it covers its box in plan.
    std::optional<std::array<double, 2>> hole() const;
    /// Volume between the surface and this level above its lowest point, from the heights of the grid.
    double volume_below(double level) const;
    /// The level below which there is this volume.
    double level_of(double volume) const;
    /// Its lowest and its highest point between two places along it, without walls in its sides.
    /// @pre its box in plan is covered
    std::array<double, 2> heights_between(double from, double to) const;
    /// The layer that rests between two places along it, its surface level across it.
    /// @param mean_depth  volume of the layer per area in plan
    /// @pre its box in plan is covered
    LevelLayer level_across(double mean_depth, double from, double to) const;
    /// The share of its area in plan that a part has, 0 to 1.
    double share_in_plan(std::string_view part) const;
};

/// Reads STL files, text or binary, whose lengths have one unit and one origin.
/// @throws std::invalid_argument with one line that describes what is wrong with it: no STL, no triangles,
/// more than 1 MiB as text (about 4000 triangles), a mesh without length or width, two
/// surfaces above each other, two files with one name, or walls that leave a part of the sides open
std::shared_ptr<TroughMesh const> read_trough_mesh(std::vector<NamedFile> files);

/// Divides triangles until no edge is longer than `longest`: the longest edge is cut in the middle, for all
/// triangles that share it, so that no gaps open (Rivara, International Journal for Numerical Methods in
/// Engineering 20, 1984, 745). The engine finds contacts fast with triangles that are not
/// much larger than grains.
std::vector<Triangle> divided(std::vector<Triangle> const& triangles, double longest);

/// One triangle of an STL text, with this normal and all digits.
std::string facet_text(Point const& normal, Triangle const& triangle);

/// An STL text of triangles with the normals of their corners' order and all digits.
std::string stl_text(std::string_view name, std::vector<Triangle> const& triangles);

}  // namespace vibrotrough::scenario
