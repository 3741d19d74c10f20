#include "scenario/model/trough_mesh.hpp"

#include "scenario/model/stl_reader.hpp"
#include "scenario/model/surface_repair.hpp"
#include "scenario/model/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr std::size_t most_bytes = 1 << 20;  ///< of the text, as of every file that a campaign names
constexpr std::size_t places = 300;          ///< of the grid in plan, along and across
constexpr double close_by =
    1e-5;  ///< of the diagonal of its box: corners closer to each other or to an end are there

void check(std::vector<Triangle> const& triangles) {
    if (triangles.empty()) throw std::invalid_argument("it has no triangles");
    if (triangles.size() > most_triangles)
        throw std::invalid_argument(fmt::format("it has more than {} triangles", most_triangles));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        double const edge = longest_edge(triangles[i]);
        if (!std::isfinite(edge) || edge > 1e6)
            throw std::invalid_argument(fmt::format("triangle {} is not finite", i + 1));
    }
}

/// Twice the area of a triangle in plan, with its sign; 0 when it is vertical.
double plan_area(Triangle const& t) {
    double const twice =
        (t[1][1] - t[2][1]) * (t[0][0] - t[2][0]) + (t[2][0] - t[1][0]) * (t[0][1] - t[2][1]);
    double const edge = longest_edge(t);
    return std::abs(twice) <= 1e-9 * edge * edge ? 0 : twice;
}

/// Height of a triangle that is not vertical at a place in plan; none outside of it.
std::optional<double> height_of(Triangle const& t, double determinant, double x, double y) {
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

/// Heights of the surface at places in plan, x[i] and y[j], row by row; NaN where there is none.
/// @throws std::invalid_argument when there are two surfaces above each other
std::vector<double> heights_at(std::vector<Triangle> const& triangles, std::vector<double> const& x,
                               std::vector<double> const& y, double most) {
    std::vector<double> heights(x.size() * y.size(), std::numeric_limits<double>::quiet_NaN());
    for (Triangle const& t : triangles) {
        double const determinant = plan_area(t);
        if (determinant == 0) continue;
        auto const [x0, x1] = std::minmax({t[0][0], t[1][0], t[2][0]});
        auto const [y0, y1] = std::minmax({t[0][1], t[1][1], t[2][1]});
        for (auto i = std::ranges::lower_bound(x, x0) - x.begin(); i < std::ssize(x); ++i) {
            if (x[static_cast<std::size_t>(i)] > x1) break;
            for (auto j = std::ranges::lower_bound(y, y0) - y.begin(); j < std::ssize(y); ++j) {
                double const at_x = x[static_cast<std::size_t>(i)], at_y = y[static_cast<std::size_t>(j)];
                if (at_y > y1) break;
                auto const height = height_of(t, determinant, at_x, at_y);
                if (!height) continue;
                double& known = heights[static_cast<std::size_t>(i) * y.size() + static_cast<std::size_t>(j)];
                if (std::abs(known - *height) > 1e-3 * most) {
                    throw std::invalid_argument(
                        fmt::format("there are two surfaces above each other at x = {:.4g}, y = {:.4g} from "
                                    "its corner; export "
                                    "only the surface that the grains touch",
                                    at_x, at_y));
                }
                if (!(*height <= known)) known = *height;
            }
        }
    }
    return heights;
}

/// Moves the box of the triangles to 0 and returns its extent.
/// @param least  receives the corner that becomes 0
Point move_to_zero(std::vector<Triangle>& triangles, Point& least) {
    Point most = least = triangles.front()[0];
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
        if (value < close_by * length(extent)) value = 0;
        if (value > extent[k] - close_by * length(extent)) value = extent[k];
    });
    return extent;
}

/// Places of the grid along one side of the box.
std::vector<double> grid(double whole) {
    std::vector<double> all;
    for (std::size_t i = 0; i < places; ++i) all.push_back(place(i, whole));
    return all;
}

/// The largest difference between two rows of heights; infinite where a surface is missing.
double mismatch(std::vector<double> const& one, std::vector<double> const& other) {
    double largest = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        double const difference = std::abs(one[i] - other[i]);
        largest =
            std::isnan(difference) ? std::numeric_limits<double>::infinity() : std::max(largest, difference);
        if (std::isinf(largest)) break;
    }
    return largest;
}

/// Whether a triangle lies in a plane of the box: k is 0 for its ends and 1 for its sides.
bool lies_at(Triangle const& t, std::size_t k, double value) {
    return std::ranges::all_of(t, [&](Point const& corner) { return corner[k] == value; });
}

/// Whether upright walls close the side at y from the surface, whose heights there are given, to the top.
/// @throws std::invalid_argument when there are walls, but not everywhere
bool is_closed(TroughMesh const& mesh, double y, std::vector<double> const& heights) {
    double walls = 0, open = 0;
    for (Triangle const& t : mesh.triangles)
        if (lies_at(t, 1, y)) walls += length(area(t)) / 2;
    for (double const height : heights)
        open += (mesh.extent[2] - height) * mesh.extent[0] / static_cast<double>(heights.size());
    if (walls == 0) return false;
    if (std::abs(walls - open) <= 0.01 * open) return true;
    throw std::invalid_argument(
        "the upright walls in one of its sides do not reach from the surface to the top of the mesh "
        "everywhere; "
        "make both walls as long as the trough and equally high");
}

/// Fills in what follows from the triangles.
void survey(TroughMesh& mesh) {
    auto const [length_x, width, top] = mesh.extent;
    std::vector<double> const x = grid(length_x), y = grid(width);
    double const most = std::max(top, 1e-6 * length_x);
    mesh.heights = heights_at(mesh.triangles, x, y, most);
    auto const row = [&](std::vector<double> const& along, std::vector<double> const& across) {
        return heights_at(mesh.triangles, along, across, std::numeric_limits<double>::infinity());
    };
    std::vector<double> const left = row(x, {0}), right = row(x, {width});
    mesh.mismatch_along = mismatch(row({0}, y), row({length_x}, y));
    mesh.mismatch_across = mismatch(left, right);
    for (Triangle const& t : mesh.triangles) {
        mesh.area += length(area(t)) / 2;
        if (lies_at(t, 0, 0)) mesh.has_end_plates[0] = true;
        if (lies_at(t, 0, length_x)) mesh.has_end_plates[1] = true;
        if (lies_at(t, 1, 0) || lies_at(t, 1, width)) continue;
        for (Point const& corner : t) mesh.floor_top = std::max(mesh.floor_top, corner[2]);
    }
    bool const is_left = is_closed(mesh, 0, left), is_right = is_closed(mesh, width, right);
    if (is_left != is_right)
        throw std::invalid_argument(
            "there is an upright wall in only one of its sides; put one in both or in none");
    mesh.has_upright_sides = is_left;
}

/// @param file  a binary one becomes a text, because its copy is kept in results, which hold texts
Solids read_file(NamedFile& file) {
    Solids solids = read_stl(file.content);
    check(solids.triangles);
    if (solids.is_binary) file.content = stl_text("trough", solids.triangles);
    if (file.content.size() > most_bytes)
        throw std::invalid_argument(
            "as a text it is larger than 1 MiB; simplify it to fewer than 4000 triangles");
    return solids;
}

/// One solid from each file.
Solids read_files(std::vector<NamedFile>& files) {
    Solids all;
    for (NamedFile& file : files) {
        std::string name = part_name(std::filesystem::path(file.name).stem().string());
        if (std::ranges::find(all.parts, name) != all.parts.end())
            throw std::invalid_argument(fmt::format("two files would be the solid '{}'", name));
        Solids const one = [&file] {
            try {
                return read_file(file);
            } catch (std::invalid_argument const& error) {
                throw std::invalid_argument(fmt::format("in {}, {}", file.name, error.what()));
            }
        }();
        all.triangles.insert(all.triangles.end(), one.triangles.begin(), one.triangles.end());
        all.part_of.resize(all.triangles.size(), all.parts.size());
        all.parts.push_back(std::move(name));
    }
    if (all.triangles.size() > most_triangles)
        throw std::invalid_argument(fmt::format("together they have more than {} triangles", most_triangles));
    return all;
}

}  // namespace

std::string TroughMesh::names() const {
    std::string text;
    for (NamedFile const& file : files) text += (text.empty() ? "" : ", ") + file.name;
    return text;
}

std::string_view name_of(MeshUnit unit) {
    constexpr std::array<std::string_view, 4> names{"mm", "m", "cm", "inch"};
    return names.at(static_cast<std::size_t>(unit));
}

double metres_in(MeshUnit unit) {
    constexpr std::array metres{1e-3, 1.0, 1e-2, 25.4e-3};
    return metres.at(static_cast<std::size_t>(unit));
}

std::shared_ptr<TroughMesh const> read_trough_mesh(std::vector<NamedFile> files) {
    Solids solids = files.size() == 1 ? read_file(files.front()) : read_files(files);
    std::vector<Triangle>& triangles = solids.triangles;
    Point least{};
    Point const extent = move_to_zero(triangles, least);
    if (!(extent[0] > 0 && extent[1] > 0))
        throw std::invalid_argument("its surface has no length or no width");
    std::vector<std::size_t> numbers(triangles.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{1});
    Surface surface{std::move(triangles), std::move(solids.part_of), std::move(numbers)};
    std::vector<std::string> repairs = mend(surface, close_by * length(extent), least);
    if (surface.triangles.empty()) throw std::invalid_argument("none of its triangles has an area");
    TroughMesh mesh{std::move(files),        std::move(surface.triangles), extent, {}, 0, 0, {}, false, 0, 0,
                    std::move(solids.parts), std::move(surface.part_of)};
    mesh.numbers = std::move(surface.numbers);
    mesh.repairs = std::move(repairs);
    survey(mesh);
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

std::array<double, 2> TroughMesh::heights_between(double from, double to) const {
    std::array<double, 2> range{std::numeric_limits<double>::infinity(), 0};
    auto const add = [&range](double height) {
        range = {std::min(range[0], height), std::max(range[1], height)};
    };
    for (Triangle const& t : triangles) {
        if (lies_at(t, 1, 0) || lies_at(t, 1, extent[1])) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            Point const &a = t[k], &b = t[(k + 1) % 3];
            if (a[0] >= from && a[0] <= to) add(a[2]);
            for (double const end : {from, to})  // where an edge crosses it
                if ((a[0] - end) * (b[0] - end) < 0) add(a[2] + (end - a[0]) / (b[0] - a[0]) * (b[2] - a[2]));
        }
    }
    return range;
}

LevelLayer TroughMesh::level_across(double mean_depth, double from, double to) const {
    auto const column = [this](double x) {
        return static_cast<std::size_t>(std::clamp(x / extent[0] * places, 0.0, places - 1.0));
    };
    LevelLayer mean{0, 0};
    double count = 0;
    for (std::size_t i = column(from); i <= column(to); ++i) {
        std::vector<double> across(heights.begin() + static_cast<std::ptrdiff_t>(i * places),
                                   heights.begin() + static_cast<std::ptrdiff_t>((i + 1) * places));
        std::ranges::sort(across);
        // The level that leaves this depth above the lowest k places, which are all that are below it.
        double const bottom = across.front();
        double depth = 0, sum = 0;
        for (std::size_t k = 1; k <= places; ++k) {
            sum += across[k - 1] - bottom;
            depth = (mean_depth * places + sum) / static_cast<double>(k);
            if (k == places || depth <= across[k] - bottom) break;
        }
        ++count;
        mean.depth += (depth - mean.depth) / count;
        mean.height += (bottom + depth - mean.height) / count;
    }
    return mean;
}

double TroughMesh::share_in_plan(std::string_view part) const {
    double its = 0, all = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        double const twice = std::abs(plan_area(triangles[i]));
        all += twice;
        if (parts[part_of[i]] == part) its += twice;
    }
    return its / all;
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

std::string facet_text(Point const& normal, Triangle const& triangle) {
    std::string text =
        fmt::format("  facet normal {} {} {}\n    outer loop\n", normal[0], normal[1], normal[2]);
    for (Point const& corner : triangle)
        text += fmt::format("      vertex {} {} {}\n", corner[0], corner[1], corner[2]);
    return text + "    endloop\n  endfacet\n";
}

std::string stl_text(std::string_view name, std::vector<Triangle> const& triangles) {
    std::string text = fmt::format("solid {}\n", name);
    for (Triangle const& t : triangles) {
        Point const normal = area(t);
        double const size = length(normal);
        text += facet_text({normal[0] / size, normal[1] / size, normal[2] / size}, t);
    }
    return text + fmt::format("endsolid {}\n", name);
}

}  // namespace vibrotrough::scenario
