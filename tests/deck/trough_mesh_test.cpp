#include "deck/trough_mesh.hpp"

#include "deck/atom_types.hpp"
#include "deck/deck.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/open_mesh.hpp"
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

/// The lines of a deck that another one does not have.
std::vector<std::string> lines_only_in(std::string const& deck, std::string const& other) {
    std::istringstream text(deck);
    std::vector<std::string> found;
    for (std::string line; std::getline(text, line);)
        if (("\n" + other).find("\n" + line + "\n") == std::string::npos) found.push_back(line);
    return found;
}

// The deck of an open trough with a flat mesh is that with the flat floor, but for the triangles and the
// forces that are stored; a mesh that is not flat needs a gate while the first grains come to rest, which
// carries none of their weight.
TEST(TroughMesh, AnOpenTroughMayHaveOne) {
    auto const deck_on = [](std::vector<scenario::Triangle> const& mesh, std::string const& trough) {
        return make_deck(prepare::prepare_case(open_mesh::scenario_on(mesh, open_mesh::campaign(trough))),
                         {1});
    };
    std::string const walls = "side_wall_friction = 0\n";
    Deck const flat = make_deck(
        prepare::prepare_case(scenario_of(with("mesh = \"own.stl\"\n", "", open_mesh::campaign(walls)))),
        {1});
    Deck const mesh = deck_on(open_mesh::slope(0, 0), walls);
    for (char const* const file : {"left.stl", "right.stl", "back.stl", control_file})
        EXPECT_EQ(mesh.files.at(file), flat.files.at(file)) << file;
    for (char const* const file : {drive_file, settle_file}) {
        std::string const &own = mesh.files.at(file), &plain = flat.files.at(file);
        EXPECT_THAT(lines_only_in(own, plain),
                    testing::ElementsAre(
                        HasSubstr("surface of own.stl"),
                        HasSubstr("mesh made from own.stl from the back wall to the edge"),
                        HasSubstr("n_meshes 4 meshes trough left right back store_force yes limitForce")));
        EXPECT_EQ(lines_only_in(plain, own).size(), 2u);
    }
    std::string const gate = "fix             gate all wall/gran model hertz primitive type 2 xplane 0.2 ";
    EXPECT_THAT(deck_on(open_mesh::slope(9, 0), walls).files.at(settle_file), HasSubstr(gate));
    EXPECT_THAT(mesh.files.at(settle_file), testing::Not(HasSubstr("gate")));

    // Between upright walls of the mesh the back wall has the friction of the trough.
    std::vector<scenario::Triangle> channel = open_mesh::slope(0, 0);
    open_mesh::add_walls(channel, 15);
    Deck const own_walls = deck_on(channel, "");
    EXPECT_FALSE(own_walls.files.contains("left.stl"));
    std::string const& drive = own_walls.files.at(drive_file);
    EXPECT_THAT(drive, HasSubstr("boundary        f f f"));
    EXPECT_THAT(drive, HasSubstr("fix             back all mesh/surface/stress file back.stl type 2 ref"));
    EXPECT_THAT(drive, HasSubstr("mesh n_meshes 2 meshes trough back store_force yes"));
    EXPECT_THAT(drive, HasSubstr("force_x equal f_trough[1]+f_back[1]\n"));
    EXPECT_THAT(drive, HasSubstr("fix             drive_back all move/mesh mesh back linear/variable"));
}

// Solids with a friction of their own and side walls are types and meshes beside each other.
TEST(TroughMesh, AnOpenOneMayHaveSolids) {
    std::vector<scenario::Triangle> floor, liner;
    open_mesh::add_floor(floor, 0, 100, 0, 0);
    open_mesh::add_floor(liner, 100, 200, 0, 0);
    std::string const pair = "\n[[pairs]]\nmaterials = [\"grains\", \"liner\"]\nfriction = 0.6\n";
    scenario::Scenario const s =
        scenario::parse_campaign(
            open_mesh::campaign("side_wall_friction = 0.1\n") + pair, "test.toml",
            {{}, {{"own.stl", scenario::stl_text("floor", floor) + scenario::stl_text("liner", liner)}}})
            .cases.front();
    Deck const deck = make_deck(prepare::prepare_case(s), {1});
    std::string const& drive = deck.files.at(drive_file);
    EXPECT_THAT(drive,
                HasSubstr("fix             part_1 all mesh/surface/stress file part.1.stl type 4 ref"));
    EXPECT_THAT(drive, HasSubstr("fix             back all mesh/surface/stress file back.stl type 3 ref"));
    EXPECT_THAT(drive, HasSubstr("mesh n_meshes 5 meshes trough part_1 left right back store_force yes"));
    EXPECT_THAT(drive, HasSubstr("coefficientFriction peratomtypepair 4 0.5 0.23 0.1 0.6 "));
    EXPECT_THAT(drive, HasSubstr("force_z equal f_trough[3]+f_part_1[3]+f_left[3]+f_right[3]+f_back[3]\n"));
}

}  // namespace
}  // namespace vibrotrough::deck
