#include "scenario/model/trough_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr std::size_t most_triangles = 20'000;
constexpr std::size_t places = 100;  ///< of the grid in plan, along and across
constexpr double at_end = 1e-6;      ///< of the length or width: nodes so close to an end lie on it
constexpr double no_area = 1e-12;    ///< of the square of the longest edge

Point minus(Point const& a, Point const& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double length(Point const& a) {
    return std::hypot(a[0], a[1], a[2]);
}

Point cross(Point const& a, Point const& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Twice the area as a vector along the normal.
Point area(Triangle const& t) {
    return cross(minus(t[1], t[0]), minus(t[2], t[0]));
}

double longest_edge(Triangle const& t) {
    return std::max({length(minus(t[1], t[0])), length(minus(t[2], t[1])), length(minus(t[0], t[2]))});
}

/// A binary STL: 80 bytes, the number of triangles, and 50 bytes for each, a normal, three corners and two
/// bytes.
constexpr std::size_t binary_head = 84, binary_triangle = 50;

std::optional<std::size_t> count_of_binary(std::string_view content) {
    if (content.size() < binary_head) return {};
    std::uint32_t count = 0;
    std::memcpy(&count, content.data() + 80, sizeof count);
    if (content.size() != binary_head + binary_triangle * std::size_t{count}) return {};
    return count;
}

std::vector<Triangle> read_binary(std::string_view content, std::size_t count) {
    static_assert(std::endian::native == std::endian::little);
    std::vector<Triangle> triangles(std::min(count, most_triangles + 1));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        std::array<float, 9> corners{};
        std::memcpy(corners.data(), content.data() + binary_head + binary_triangle * i + 12, sizeof corners);
        for (std::size_t k = 0; k < 9; ++k) triangles[i][k / 3][k % 3] = corners[k];
    }
    return triangles;
}

std::vector<Triangle> read_text(std::string_view content) {
    std::istringstream text{std::string(content)};
    text.imbue(std::locale::classic());
    std::vector<Triangle> triangles;
    std::string word;
    if (!(text >> word) || word != "solid")
        throw std::invalid_argument("it is neither a text nor a binary STL");
    std::size_t corner = 0;
    Triangle triangle{};
    while (text >> word && triangles.size() <= most_triangles) {
        if (word != "vertex") continue;
        Point& p = triangle[corner];
        if (!(text >> p[0] >> p[1] >> p[2]))
            throw std::invalid_argument(
                fmt::format("a corner of triangle {} is not three numbers", triangles.size() + 1));
        corner = (corner + 1) % 3;
        if (corner == 0) triangles.push_back(triangle);
    }
    if (corner != 0) throw std::invalid_argument("its last triangle has fewer than three corners");
    return triangles;
}

void check(std::vector<Triangle> const& triangles) {
    if (triangles.empty()) throw std::invalid_argument("it has no triangles");
    if (triangles.size() > most_triangles)
        throw std::invalid_argument(fmt::format("it has more than {} triangles", most_triangles));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        double const edge = longest_edge(triangles[i]);
        if (!std::isfinite(edge) || edge > 1e6)
            throw std::invalid_argument(fmt::format("triangle {} is not finite", i + 1));
        if (length(area(triangles[i])) <= no_area * edge * edge)
            throw std::invalid_argument(fmt::format("triangle {} has no area", i + 1));
    }
}

/// Height of a triangle at a place in plan; none outside of it and for vertical ones.
std::optional<double> height_of(Triangle const& t, double x, double y) {
    double const determinant =
        (t[1][1] - t[2][1]) * (t[0][0] - t[2][0]) + (t[2][0] - t[1][0]) * (t[0][1] - t[2][1]);
    double const edge = longest_edge(t);
    if (std::abs(determinant) <= 1e-9 * edge * edge) return {};
    double const a =
        ((t[1][1] - t[2][1]) * (x - t[2][0]) + (t[2][0] - t[1][0]) * (y - t[2][1])) / determinant;
    double const b =
        ((t[2][1] - t[0][1]) * (x - t[2][0]) + (t[0][0] - t[2][0]) * (y - t[2][1])) / determinant;
    constexpr double rounding = 1e-9;
    if (a < -rounding || b < -rounding || a + b > 1 + rounding) return {};
    return a * t[0][2] + b * t[1][2] + (1 - a - b) * t[2][2];
}

double place(std::size_t i, double whole) {
    return (static_cast<double>(i) + 0.5) / places * whole;
}

/// The uppermost triangle at a place in plan; NaN where there is none.
double height_at(std::vector<Triangle> const& triangles, double x, double y) {
    double highest = std::numeric_limits<double>::quiet_NaN();
    for (Triangle const& triangle : triangles) {
        auto const height = height_of(triangle, x, y);
        if (height && !(*height <= highest)) highest = *height;
    }
    return highest;
}

/// Moves the box of the triangles to 0 and returns its extent.
Point move_to_zero(std::vector<Triangle>& triangles) {
    Point least = triangles.front()[0], most = least;
    auto const for_all = [&](auto const& function) {
        for (Triangle& triangle : triangles)
            for (Point& corner : triangle)
                for (std::size_t k = 0; k < 3; ++k) function(corner[k], k);
    };
    for_all([&](double value, std::size_t k) {
        least[k] = std::min(least[k], value);
        most[k] = std::max(most[k], value);
    });
    Point const extent = minus(most, least);
    for_all([&](double& value, std::size_t k) {
        value -= least[k];
        if (k == 2) return;
        if (value < at_end * extent[k]) value = 0;
        if (value > (1 - at_end) * extent[k]) value = extent[k];
    });
    return extent;
}

/// The largest difference in height between the ends of the mesh in one direction.
double mismatch(TroughMesh const& mesh, std::size_t direction) {
    double largest = 0;
    for (std::size_t i = 0; i < places; ++i) {
        double const other = place(i, mesh.extent[1 - direction]), end = mesh.extent[direction];
        auto const height = [&](double at) {
            return direction == 0 ? height_at(mesh.triangles, at, other)
                                  : height_at(mesh.triangles, other, at);
        };
        double const difference = std::abs(height(0) - height(end));
        if (!(difference <= largest)) largest = difference;
    }
    return largest;
}

bool has_upright_side(TroughMesh const& mesh) {
    return std::ranges::any_of(mesh.triangles, [&](Triangle const& t) {
        auto const all_at = [&](double y) {
            return std::ranges::all_of(t, [y](Point const& corner) { return corner[1] == y; });
        };
        return all_at(0) || all_at(mesh.extent[1]);
    });
}

}  // namespace

std::string_view name_of(MeshUnit unit) {
    constexpr std::array<std::string_view, 2> names{"mm", "m"};
    return names.at(static_cast<std::size_t>(unit));
}

double metres_in(MeshUnit unit) {
    return unit == MeshUnit::mm ? 1e-3 : 1;
}

std::shared_ptr<TroughMesh const> read_trough_mesh(NamedFile file) {
    auto const binary = count_of_binary(file.content);
    std::vector<Triangle> triangles = binary ? read_binary(file.content, *binary) : read_text(file.content);
    check(triangles);
    // A copy is kept in results, which hold texts.
    if (binary) file.content = stl_text("trough", triangles);
    Point const extent = move_to_zero(triangles);
    if (!(extent[0] > 0 && extent[1] > 0))
        throw std::invalid_argument("its surface has no length or no width");
    TroughMesh mesh{std::move(file), std::move(triangles), extent, {}, 0, 0, false};
    for (std::size_t i = 0; i < places; ++i)
        for (std::size_t j = 0; j < places; ++j)
            mesh.heights.push_back(height_at(mesh.triangles, place(i, extent[0]), place(j, extent[1])));
    mesh.mismatch_along = mismatch(mesh, 0);
    mesh.mismatch_across = mismatch(mesh, 1);
    mesh.has_upright_sides = has_upright_side(mesh);
    return std::make_shared<TroughMesh const>(std::move(mesh));
}

std::optional<std::array<double, 2>> TroughMesh::hole() const {
    auto const found = std::ranges::find_if(heights, [](double height) { return std::isnan(height); });
    if (found == heights.end()) return {};
    auto const at = static_cast<std::size_t>(found - heights.begin());
    return std::array{place(at / places, extent[0]), place(at % places, extent[1])};
}

double TroughMesh::volume_below(double level) const {
    double depth = 0;
    for (double const height : heights) depth += std::max(0.0, level - height);
    return depth * extent[0] * extent[1] / static_cast<double>(heights.size());
}

double TroughMesh::level_of(double volume) const {
    double low = 0, high = extent[2] + volume / (extent[0] * extent[1]);
    for (int i = 0; i < 60; ++i) {
        double const middle = (low + high) / 2;
        (volume_below(middle) < volume ? low : high) = middle;
    }
    return high;
}

std::vector<Triangle> divided(std::vector<Triangle> const& triangles, double longest) {
    std::vector<Triangle> result, left(triangles.rbegin(), triangles.rend());
    while (!left.empty()) {
        Triangle t = left.back();
        left.pop_back();
        // The longest edge is from the first to the second corner.
        std::array<double, 3> const edges{length(minus(t[1], t[0])), length(minus(t[2], t[1])),
                                          length(minus(t[0], t[2]))};
        std::rotate(t.begin(), t.begin() + (std::ranges::max_element(edges) - edges.begin()), t.end());
        if (std::ranges::max(edges) <= longest) {
            result.push_back(t);
            continue;
        }
        Point middle{};
        for (std::size_t k = 0; k < 3; ++k) middle[k] = (t[0][k] + t[1][k]) / 2;
        left.push_back({middle, t[1], t[2]});
        left.push_back({t[0], middle, t[2]});
    }
    return result;
}

std::string stl_text(std::string_view name, std::vector<Triangle> const& triangles) {
    std::string text = fmt::format("solid {}\n", name);
    for (Triangle const& t : triangles) {
        Point const normal = area(t);
        double const size = length(normal);
        text += fmt::format("  facet normal {} {} {}\n    outer loop\n", normal[0] / size, normal[1] / size,
                            normal[2] / size);
        for (Point const& corner : t)
            text += fmt::format("      vertex {} {} {}\n", corner[0], corner[1], corner[2]);
        text += "    endloop\n  endfacet\n";
    }
    return text + fmt::format("endsolid {}\n", name);
}

}  // namespace vibrotrough::scenario
