#include "deck/trough_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

struct Node {
    double x, y;
};

std::string facet(std::array<Node, 3> const& nodes) {
    std::string text = "  facet normal 0 0 1\n    outer loop\n";
    for (Node const& node : nodes) text += fmt::format("      vertex {} {} 0\n", node.x, node.y);
    return text + "    endloop\n  endfacet\n";
}

}  // namespace

std::string flat_trough_stl(double length, double width, double edge) {
    int const across = std::max(1, static_cast<int>(std::lround(width / edge)));
    int const along = std::max(1, static_cast<int>(std::lround(length * across / width)));
    // The last node is the length itself, not a product that rounds beside it.
    auto const node = [&](int i, int j) {
        return Node{i == along ? length : length * i / along, j == across ? width : width * j / across};
    };
    std::string text = "solid trough\n";
    for (int i = 0; i < along; ++i) {
        for (int j = 0; j < across; ++j) {
            text += facet({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
            text += facet({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
        }
    }
    return text + "endsolid trough\n";
}

}  // namespace vibrotrough::deck
