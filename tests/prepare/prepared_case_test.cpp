#include "prepare/prepared_case.hpp"

#include "scenario/example_campaign.hpp"
#include "scenario/open_mesh.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::prepare {
namespace {

// What the user gave is kept, not computed back from the frequency.
TEST(PreparedCase, KeepsTheNumbersAsGiven) {
    for (double const given : {0.7, 1.1, 1.7, 2.3, 2.9}) {
        auto const by_throw =
            prepare_case(scenario_of(with("throw_number = 2.0", fmt::format("throw_number = {}", given))));
        EXPECT_EQ(by_throw.throw_number, given);
        auto const by_machine =
            prepare_case(scenario_of(with("throw_number = 2.0", fmt::format("machine_number = {}", given))));
        EXPECT_EQ(by_machine.machine_number, given);
        EXPECT_EQ(by_throw.point_mass.conveyor.point.throw_number, given);
    }
}

// Gamma = K sin(beta) / cos(alpha), v = omega r cos(beta); the example has beta = 30 deg, alpha = 0, r = 6
// mm.
TEST(PreparedCase, DriveNumbersBelongTogether) {
    PreparedCase const c = prepare_case(scenario_of());
    EXPECT_NEAR(c.machine_number, 4, 1e-12);
    EXPECT_NEAR(c.angular_frequency, std::sqrt(4 * 9.81 / 6e-3), 1e-9);
    EXPECT_NEAR(c.velocity_scale, c.angular_frequency * 6e-3 * std::cos(std::numbers::pi / 6), 1e-12);
}

TEST(PreparedCase, AClumpCostsItsSpheres) {
    PreparedCase const spheres = prepare_case(scenario_of());
    PreparedCase const cubes = prepare_case(scenario_of(with("diameter_spread = 0.1", "shape = \"cube\"")));
    EXPECT_EQ(spheres.spheres_per_grain, 1);
    EXPECT_EQ(cubes.spheres_per_grain, 8);
    EXPECT_DOUBLE_EQ(cubes.grain_steps(10),
                     8.0 * cubes.scenario.layer.grains * cubes.time.steps_per_cycle * 10);
}

// cost = grain-steps (1 + 2 / (1 + (30,000 / n)^1.5)): what a step of a grain was measured to cost among n
// spheres, over what it costs when the engine is probed with 1000 (src/manual/costs.md). The expected
// values are geometric means over two days, which were 1.4 times apart; for 3000 spheres nothing is seen.
// Tolerance: a tenth, much less than the days differ, and more than a curve of two constants misses them by.
TEST(PreparedCase, AStepCostsMoreInALargeLayer) {
    EXPECT_NEAR(relative_step_cost(100), 1, 0.001);
    EXPECT_NEAR(relative_step_cost(3000), 1, 0.1);
    EXPECT_NEAR(relative_step_cost(10'000), 1.35, 0.135);
    EXPECT_NEAR(relative_step_cost(100'000), 2.6, 0.26);
    EXPECT_LT(relative_step_cost(1e6), 3);
    PreparedCase const c = prepare_case(scenario_of(with("height = \"12 mm\"", "grains = 100000")));
    EXPECT_DOUBLE_EQ(c.work(3), c.grain_steps(3) * relative_step_cost(c.scenario.layer.grains));
}

// What is taken out of an open trough has left it: a grain whose centre is at out_x lies as a whole beyond
// the edge, wherever the trough is, and one at out_near_x still rests on it.
TEST(PreparedCase, AnOpenTroughKeepsTheGrainsThatAreStillOverIt) {
    std::string const text =
        with("height = \"12 mm\"\n", "", with("36 mm", "200 mm")) + "[feed]\nmass_flow = \"0.1 t/h\"\n";
    PreparedCase const c =
        prepare_case(scenario_of(with("friction = 0.23", "friction = 0.23\nside_wall_friction = 0", text)));
    OpenTrough const& open = c.domain.open.value();
    double const edge = c.scenario.layer.length, excursion = largest_excursion(c.motion);
    EXPECT_GE(open.out_x - c.largest_extent / 2, edge + excursion);
    EXPECT_LE(open.out_near_x + c.largest_extent / 2, edge - excursion);
}

// A light grain that a heavy one hits flies up to 2 M / (M + m) as fast, to any side: 16/9 for an eighth of
// the mass and sizes that are alike.
TEST(PreparedCase, LightGrainsOfAFedMixtureHaveRoom) {
    std::string const text = with("diameter_spread = 0.1", "diameter_spread = 0",
                                  with("height = \"12 mm\"\n", "", with("36 mm", "200 mm"))) +
                             "[feed]\nmass_flow = \"0.1 t/h\"\n";
    std::string const walls = with("friction = 0.23", "friction = 0.23\nside_wall_friction = 0", text);
    auto const flight = [](PreparedCase const& c, double factor) {
        return factor * 2 * c.largest_speed / c.scenario.trough.frequency + 2 * c.largest_extent;
    };
    PreparedCase const alike = prepare_case(scenario_of(walls));
    EXPECT_NEAR(alike.domain.open->box_side, flight(alike, 1) / 2, 1e-12);
    PreparedCase const mixed = prepare_case(
        scenario_of(walls + "[[materials]]\nname = \"fines\"\nmass_fraction = 0.1\ndiameter = \"1.5 mm\"\n"));
    EXPECT_NEAR(mixed.domain.open->box_side, flight(mixed, 16.0 / 9), 1e-12);
}

// The same on a mesh, whose edge may be anywhere: what lies on it is above out_z behind out_near_x, and the
// box reaches below its lowest point.
TEST(PreparedCase, AnOpenTroughOfOnesOwnKeepsTheGrainsThatAreStillOverIt) {
    PreparedCase const flat = prepare_case(open_mesh::scenario_on(open_mesh::slope(0, 0)));
    for (auto const& [mesh, at_edge, deep] :
         {std::tuple{open_mesh::slope(0, 0), 0.0, 0.0}, std::tuple{open_mesh::slope(0, 40), 0.036, 0.0},
          std::tuple{open_mesh::slope(40, 0), 0.0, 0.0}, std::tuple{open_mesh::vee(), 0.0, 0.009}}) {
        PreparedCase const c = prepare_case(open_mesh::scenario_on(mesh));
        OpenTrough const &open = c.domain.open.value(), &level = flat.domain.open.value();
        EXPECT_EQ(open.out_x, level.out_x);
        EXPECT_LE(open.out_near_x, level.out_near_x - deep + 1e-9);
        EXPECT_NEAR(open.out_z - level.out_z, at_edge, 0.003);
        EXPECT_LE(c.box_bottom, flat.box_bottom);
        EXPECT_GT(open.feed_bottom, c.domain.floor_top * open.feed_end / c.scenario.layer.length);
        EXPECT_GT(c.fill_bottom, c.domain.floor_top);
        EXPECT_GT(c.wall_height, open.feed_top);
        EXPECT_TRUE(c.domain.is_closed);
    }
    // Upright walls of the mesh end below the top of the box.
    std::vector<scenario::Triangle> channel = open_mesh::slope(0, 0);
    open_mesh::add_walls(channel, 900);
    PreparedCase const c = prepare_case(open_mesh::scenario_on(channel, open_mesh::campaign("")));
    EXPECT_GT(c.wall_height, 0.9);
}

}  // namespace
}  // namespace vibrotrough::prepare
