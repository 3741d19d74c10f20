#include "deck/trough_mesh.hpp"

#include "deck/atom_types.hpp"
#include "deck/commands.hpp"
#include "deck/deck.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

using testing::HasSubstr;

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

/// A channel of the example's box in millimetres: a floor, and walls of a solid of their own.
prepare::PreparedCase lined_channel(std::string const& walls = "walls") {
    auto const rectangle = [](scenario::Point a, scenario::Point b, scenario::Point c, scenario::Point d) {
        return std::vector<scenario::Triangle>{{a, b, c}, {a, c, d}};
    };
    std::string const text =
        scenario::stl_text("floor", rectangle({0, 0, 0}, {36, 0, 0}, {36, 18, 0}, {0, 18, 0})) +
        scenario::stl_text(walls, rectangle({0, 0, 0}, {36, 0, 0}, {36, 0, 15}, {0, 0, 15})) +
        scenario::stl_text(walls, rectangle({0, 18, 0}, {36, 18, 0}, {36, 18, 15}, {0, 18, 15}));
    scenario::Scenario s = scenario::parse_campaign(example_campaign, "test.toml").cases.front();
    s.trough.mesh = scenario::read_trough_mesh({{"channel.stl", text}});
    s.pairs = {{.materials = {walls, "grains"}, .friction = 0.1}};
    return prepare::prepare_case(s);
}

// A solid with a friction of its own is a mesh and an atom type of its own, and moves with the trough. Its
// walls go on to the top of the box. The mesh of the trough alone, which has the reference point, stays the
// first.
TEST(TroughMesh, SolidsWithAFrictionOfTheirOwnAreMeshesOfTheirOwn) {
    prepare::PreparedCase const lined = lined_channel();
    Deck const deck = make_deck(lined, {1});
    auto const [low, high] = std::ranges::minmax(vertices(deck.files.at("trough.stl")), {}, &Vertex::z);
    EXPECT_EQ(low.z, 0);
    EXPECT_EQ(high.z, 0);
    EXPECT_EQ(std::ranges::max(vertices(deck.files.at("part.1.stl")), {}, &Vertex::z).z, lined.wall_height);
    for (char const* const file : {settle_file, drive_file}) {
        std::string const& commands = deck.files.at(file);
        EXPECT_THAT(commands,
                    HasSubstr("fix             part_1 all mesh/surface/stress file part.1.stl type 3 ref"));
        EXPECT_THAT(commands, HasSubstr("mesh n_meshes 2 meshes trough part_1 store_force yes"));
        // Grains, trough, walls: rows of the table of frictions.
        EXPECT_THAT(
            commands,
            HasSubstr("coefficientFriction peratomtypepair 3 0.5 0.23 0.1 0.23 0.23 0.23 0.1 0.23 0.23\n"));
    }
    std::string const& moving = deck.files.at(drive_file);
    EXPECT_THAT(moving, HasSubstr("move/mesh mesh part_1 linear/variable v_speed_x v_speed_y v_speed_z\n"));
    EXPECT_THAT(moving, HasSubstr("force_x equal f_trough[1]+f_part_1[1]\n"));
    EXPECT_THAT(moving, HasSubstr("force_z equal f_trough[3]+f_part_1[3]\n"));
    EXPECT_EQ(atom_types(lined).back().name, "walls");
    // A solid may be called as the trough, whose friction stays.
    EXPECT_EQ(pair_tables(lined_channel("trough")).frictions, "0.5 0.23 0.1 0.23 0.23 0.23 0.1 0.23 0.23");
}

}  // namespace
}  // namespace vibrotrough::deck
