#include "open_mesh.hpp"

#include "core/error.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::scenario {
namespace {

using namespace open_mesh;
using testing::HasSubstr;

std::string refusal(std::vector<Triangle> const& mesh, std::string const& text = open_mesh::campaign()) {
    try {
        scenario_on(mesh, text);
    } catch (core::InputError const& error) {
        return error.what();
    }
    return "no error";
}

// A flat mesh is the flat floor: the same heights, and so the same layer.
TEST(OpenMesh, AFlatOneIsTheFlatFloor) {
    std::string const flat_floor = with("mesh = \"own.stl\"\n", "", open_mesh::campaign());
    Scenario const mesh = scenario_on(slope(0, 0)), flat = scenario_of(flat_floor);
    EXPECT_EQ(mesh.layer.grains, flat.layer.grains);
    EXPECT_NEAR(layer_height(mesh) / layer_height(flat), 1, 1e-12);
    EXPECT_NEAR(feed_height(mesh) / feed_height(flat), 1, 1e-12);
    EXPECT_EQ(floor_under_feed(mesh), 0);
    EXPECT_EQ(to_toml(scenario_of(to_toml(flat))), to_toml(flat));
    EXPECT_THAT(to_toml(mesh), HasSubstr("mesh = \"own.stl\""));
}

// The two ends need not be the same, and the layer does not collect at the lower one: on a slope it is as
// deep as on a level floor.
TEST(OpenMesh, MayFallOrRise) {
    Scenario const level = scenario_on(slope(0, 0));
    for (auto const& [start, end] : {std::pair{0.0, 6.0}, std::pair{6.0, 0.0}}) {
        Scenario const s = scenario_on(slope(start, end));
        EXPECT_NEAR(layer_height(s) / layer_height(level), 1, 1e-9);
        // The stream falls onto the first 20 mm, under which the trough moves.
        EXPECT_NEAR(floor_under_feed(s), start > 0 ? 0.006 : 0.0011, 2e-4);
        EXPECT_NEAR(layer_under_feed(s) - layer_height(s), start > 0 ? 0.0055 : 0.0005, 2e-4);
        EXPECT_NEAR(feed_height(s), floor_under_feed(s) + 2 * layer_height(s) + 6 * largest_diameter(s),
                    1e-12);
    }
}

// In a V of 45 degrees a layer of the mean depth m is h deep: h^2 = m w, below its sides.
TEST(OpenMesh, DepthIsAboveTheLowestPointOfACrossSection) {
    Scenario const s = scenario_on(vee());
    EXPECT_NEAR(layer_height(s), std::sqrt(mean_layer_depth(s) * 0.018), 1e-4);
    EXPECT_GT(layer_height(s), 1.5 * mean_layer_depth(s));
    EXPECT_NEAR(floor_under_feed(s), 0.009, 1e-12);
}

// volume_below() is the other way round: the volume below the surface, here of a prism.
TEST(OpenMesh, TheLevelHasTheVolumeBelowIt) {
    auto const read = [](std::vector<Triangle> const& mesh) {
        return read_trough_mesh({{"a.stl", stl_text("a", mesh)}});
    };
    std::vector<Triangle> channel = slope(0, 0);
    add_walls(channel, 15);
    for (auto const& mesh : {read(vee()), read(channel), read(slope(0, 0))}) {
        for (double const mean : {0.1, 2.0, 4.5, 30.0}) {
            LevelLayer const layer = mesh->level_across(mean, 0, 200);
            EXPECT_NEAR(mesh->volume_below(layer.height) / (200 * 18 * mean), 1, 1e-9);
            EXPECT_NEAR(layer.depth, layer.height, 18 / 500.0) << "the bottom of a V lies between two places";
        }
    }
    // A step of 5 mm halfway: each half has its own level.
    std::vector<Triangle> steps;
    add_floor(steps, 0, 100, 5, 5);
    add_floor(steps, 100, 200, 0, 0);
    auto const mesh = read(steps);
    EXPECT_NEAR(mesh->level_across(3, 0, 99).height, 8, 1e-12);
    EXPECT_NEAR(mesh->level_across(3, 101, 200).height, 3, 1e-12);
    EXPECT_NEAR(mesh->level_across(3, 0, 200).depth, 3, 1e-12);
    EXPECT_EQ(mesh->heights_between(0, 100), (std::array<double, 2>{0, 5})) << "the step is on its edge";
    EXPECT_EQ(mesh->heights_between(0, 99), (std::array<double, 2>{5, 5}));
    // An edge of a triangle that crosses an end counts to there.
    EXPECT_NEAR(read(slope(0, 10))->heights_between(50, 150)[0], 2.5, 1e-12);
    EXPECT_NEAR(read(slope(0, 10))->heights_between(50, 150)[1], 7.5, 1e-12);
}

TEST(OpenMesh, WhatItLacksIsNamed) {
    EXPECT_THAT(refusal(slope(0, 0), open_mesh::campaign("")), HasSubstr("needs trough.side_wall_friction"));
    EXPECT_THAT(refusal(vee(), open_mesh::campaign("")), HasSubstr("needs trough.side_wall_friction"));
    std::vector<Triangle> channel = slope(0, 0);
    add_walls(channel, 15);
    EXPECT_EQ(refusal(channel, open_mesh::campaign("")), "no error");
    EXPECT_THAT(refusal(channel), HasSubstr("trough.side_wall_friction: does not go with trough.mesh"));
    // Shorter or longer than the trough.
    for (char const* const length : {"190 mm", "210 mm"})
        EXPECT_THAT(refusal(slope(0, 0), with("200 mm", length, open_mesh::campaign())),
                    HasSubstr(std::string("it is 200 mm long, and layer.length is ") + length));
    std::vector<Triangle> gap;
    add_floor(gap, 0, 95, 0, 0);
    add_floor(gap, 100, 200, 0, 0);
    EXPECT_THAT(refusal(gap), HasSubstr("there is a hole in plan at x = 95"));
    std::vector<Triangle> oblique;  // an edge that is not across the trough
    oblique.push_back({Point{0, 0, 0}, Point{200, 0, 0}, Point{190, 18, 0}});
    oblique.push_back({Point{0, 0, 0}, Point{190, 18, 0}, Point{0, 18, 0}});
    EXPECT_THAT(refusal(oblique), HasSubstr("there is a hole in plan at x = 19"));
    std::vector<Triangle> closed = slope(0, 0);
    closed.push_back({Point{0, 0, 0}, Point{0, 18, 0}, Point{0, 18, 9}});
    EXPECT_THAT(refusal(closed), HasSubstr("an upright plate in its first end"));
    std::vector<Triangle> weir = slope(0, 0);  // a lip at the edge, over which the grains leave
    weir.push_back({Point{200, 0, 0}, Point{200, 18, 0}, Point{200, 18, 2}});
    weir.push_back({Point{200, 0, 0}, Point{200, 18, 2}, Point{200, 0, 2}});
    EXPECT_EQ(refusal(weir), "no error");
    // The stream would begin inside of the mesh.
    std::string const low = "mass_flow = \"0.1 t/h\"\nheight = \"15 mm\"\n";
    EXPECT_EQ(refusal(slope(0, 0), open_mesh::campaign("side_wall_friction = 0\n", low)), "no error");
    EXPECT_THAT(
        refusal(slope(20, 0), open_mesh::campaign("side_wall_friction = 0\n", low)),
        HasSubstr("15 mm is less than 3 of the largest diameters above the highest point of the floor"));
    // Behind the feed the mesh may be higher.
    EXPECT_EQ(refusal(slope(0, 20), open_mesh::campaign("side_wall_friction = 0\n", low)), "no error");
    EXPECT_THAT(
        refusal(slope(0, 0), open_mesh::campaign() + "[screen]\nopening = \"2 mm\"\nwire = \"1 mm\"\n"),
        HasSubstr("a screen is a flat floor with square holes"));
}

}  // namespace
}  // namespace vibrotrough::scenario
