#include "deck/trough_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

struct Vertex {
    double x, y, z;
};

std::vector<Vertex> vertices(std::string const& stl) {
    std::vector<Vertex> found;
    std::istringstream text(stl);
    for (std::string word; text >> word;) {
        Vertex v{};
        if (word == "vertex" && text >> v.x >> v.y >> v.z) found.push_back(v);
    }
    return found;
}

double distance(Vertex const& a, Vertex const& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

// Nodes beyond a periodic face overlap their own image (contacts tripled); nodes short of it leave a gap.
TEST(TroughMesh, EndsExactlyOnThePeriodicFaces) {
    for (double const length : {0.036, 0.1, 1.0 / 3}) {
        for (double const width : {0.018, 0.0133333, 0.2}) {
            auto const nodes = vertices(flat_trough_stl(length, width, 0.009));
            auto const [left, right] = std::ranges::minmax(nodes, {}, &Vertex::x);
            auto const [front, back] = std::ranges::minmax(nodes, {}, &Vertex::y);
            EXPECT_EQ(left.x, 0);
            EXPECT_EQ(right.x, length);  // the very same double
            EXPECT_EQ(front.y, 0);
            EXPECT_EQ(back.y, width);
        }
    }
}

// The triangles cover the floor once, face up, and none is long and thin (LIGGGHTS aborts on those).
TEST(TroughMesh, CoversTheFloorOnceWithStoutTriangles) {
    for (double const width : {0.005, 0.018, 0.2}) {
        auto const nodes = vertices(flat_trough_stl(0.1, width, 0.009));
        ASSERT_EQ(nodes.size() % 3, 0u);
        double area = 0;
        for (std::size_t i = 0; i < nodes.size(); i += 3) {
            Vertex const &a = nodes[i], &b = nodes[i + 1], &c = nodes[i + 2];
            double const twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
            EXPECT_GT(twice, 0);
            area += twice / 2;
            double const longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
            double const shortest = std::min({distance(a, b), distance(b, c), distance(c, a)});
            EXPECT_LT(longest / shortest,
                      3.3);  // two triangles on 100 x 10 mm (ratio 10) aborted, square cells have 1.4
        }
        EXPECT_NEAR(area, 0.1 * width, 1e-12 * area + 1e-15);  // sums of products of doubles
    }
}

}  // namespace
}  // namespace vibrotrough::deck
