#include "deck/trough_mesh.hpp"

#include "scenario/model/surface_repair.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

using Node = scenario::Point;

/// A rectangle over x in [0, length] and another coordinate in [0, width]. `node_at` gives the node at (x,
/// other).
template <typename NodeAt>
std::string rectangle(std::string const& name, double length, double width, double edge, Node const& normal,
                      NodeAt const& node_at) {
    int const across = std::max(1, static_cast<int>(std::lround(width / edge)));
    int const along = std::max(1, static_cast<int>(std::lround(length * across / width)));
    // The last node is exactly at the length, where a product could differ from it by rounding.
    auto const node = [&](int i, int j) {
        return node_at(i == along ? length : length * i / along, j == across ? width : width * j / across);
    };
    std::string text = fmt::format("solid {}\n", name);
    for (int i = 0; i < along; ++i) {
        for (int j = 0; j < across; ++j) {
            text += scenario::facet_text(normal, {node(i, j), node(i + 1, j), node(i + 1, j + 1)});
            text += scenario::facet_text(normal, {node(i, j), node(i + 1, j + 1), node(i, j + 1)});
        }
    }
    return text + fmt::format("endsolid {}\n", name);
}

/// Where the triangles of a screen have their nodes along one axis, and whether there are holes between two
/// of them.
struct ScreenNodes {
    std::vector<double> at;
    std::vector<bool> open;  ///< one fewer
};

ScreenNodes screen_nodes(double side, double opening, int holes, double plate) {
    double const pitch = (side - plate) / holes, bar = pitch - opening;
    int const parts = std::max(1, static_cast<int>(std::lround(opening / (2 * bar))));
    ScreenNodes nodes{{0}, {}};
    auto const add = [&nodes](double to, bool open) {
        nodes.at.push_back(to);
        nodes.open.push_back(open);
    };
    int const closed = static_cast<int>(std::ceil(plate / (2 * bar)));
    for (int part = 1; part <= closed; ++part) add(plate * part / closed, false);
    for (int hole = 0; hole < holes; ++hole) {
        double const start = plate + hole * pitch + bar / 2;
        add(start, false);
        for (int part = 1; part <= parts; ++part) add(start + opening * part / parts, true);
        add(hole + 1 == holes ? side : plate + (hole + 1) * pitch, false);
    }
    return nodes;
}

/// Whether a surface has a triangle in the side at y that has a corner at this height.
bool reaches_top(std::vector<scenario::Triangle> const& surface, double y, double top) {
    return std::ranges::any_of(surface, [&](scenario::Triangle const& triangle) {
        return std::ranges::all_of(triangle, [&](Node const& corner) { return corner[1] == y; }) &&
               std::ranges::any_of(triangle, [&](Node const& corner) { return corner[2] == top; });
    });
}

}  // namespace

std::vector<std::vector<scenario::Triangle>> own_trough(prepare::PreparedCase const& prepared) {
    scenario::Layer const& layer = prepared.scenario.layer;
    prepare::Domain const& domain = prepared.domain;
    double const edge = 3 * mean_diameter(prepared.scenario);
    std::vector<std::vector<scenario::Triangle>> all{scenario::divided(domain.surface, edge)};
    for (prepare::TroughPart const& part : domain.parts) all.push_back(scenario::divided(part.surface, edge));
    for (double const y : {0.0, layer.width}) {
        if (!prepared.scenario.trough.mesh->has_upright_sides) break;
        scenario::Point const a{0, y, domain.top}, b{layer.length, y, domain.top},
            c{layer.length, y, prepared.wall_height}, d{0, y, prepared.wall_height};
        auto const below =
            std::ranges::find_if(all, [&](auto const& part) { return reaches_top(part, y, domain.top); });
        for (scenario::Triangle const& triangle : scenario::divided({{a, b, c}, {a, c, d}}, 4 * edge))
            (below == all.end() ? all.front() : *below).push_back(triangle);
    }
    return all;
}

double smallest_angle_of_mesh(prepare::PreparedCase const& prepared) {
    double least = 180;
    for (auto const& part : own_trough(prepared))
        for (scenario::Triangle const& triangle : part)
            least = std::min(least, scenario::smallest_angle(triangle) * 180 / std::numbers::pi);
    return least;
}

std::string part_mesh(std::size_t part) {
    return fmt::format("part_{}", part + 1);
}

std::string part_file(std::size_t part) {
    return fmt::format("part.{}.stl", part + 1);
}

std::string screen_stl(double length, double width, double opening, int along, int across, double plate) {
    ScreenNodes const x = screen_nodes(length, opening, along, plate),
                      y = screen_nodes(width, opening, across, 0);
    std::string text = "solid trough\n";
    for (std::size_t i = 0; i + 1 < x.at.size(); ++i) {
        for (std::size_t j = 0; j + 1 < y.at.size(); ++j) {
            if (x.open[i] && y.open[j]) continue;
            Node const a{x.at[i], y.at[j], 0}, b{x.at[i + 1], y.at[j], 0}, c{x.at[i + 1], y.at[j + 1], 0},
                d{x.at[i], y.at[j + 1], 0};
            text += scenario::facet_text({0, 0, 1}, {a, b, c}) + scenario::facet_text({0, 0, 1}, {a, c, d});
        }
    }
    return text + "endsolid trough\n";
}

int screen_triangles(double length, double width, double opening, int along, int across, double plate) {
    auto const closed_and_open = [](ScreenNodes const& nodes) {
        auto const open = std::ranges::count(nodes.open, true);
        return std::pair(nodes.open.size(), static_cast<std::size_t>(open));
    };
    auto const [x, open_x] = closed_and_open(screen_nodes(length, opening, along, plate));
    auto const [y, open_y] = closed_and_open(screen_nodes(width, opening, across, 0));
    return static_cast<int>(2 * (x * y - open_x * open_y));
}

std::string flat_trough_stl(double length, double width, double edge) {
    return rectangle("trough", length, width, edge, {0, 0, 1}, [](double x, double y) {
        return Node{x, y, 0};
    });
}

std::string side_wall_stl(double length, double height, double y, double edge) {
    return rectangle("wall", length, height, edge, {0, 1, 0}, [y](double x, double z) {
        return Node{x, y, z};
    });
}

std::string cross_wall_stl(double width, double bottom, double top, double x, double edge) {
    return rectangle("wall", width, top - bottom, edge, {1, 0, 0}, [=](double y, double z) {
        return Node{x, y, bottom + z};
    });
}

}  // namespace vibrotrough::deck
