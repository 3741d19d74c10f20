#include "example_campaign.hpp"
#include "single_case.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

// What a case cannot have together, and what needs something else.
namespace vibrotrough {
namespace {

/// What is refused, where, and because of which other key.
struct Refusal {
    std::string text;
    char const *key, *other;
};

/// The example whose grains have one size, with other lines in [trough], [grains], [layer] and below.
std::string case_with(std::string const& below, std::string const& trough = "",
                      std::string const& grains = "", std::string const& height = "height = \"12 mm\"\n") {
    std::string text = with("rolling_friction = 0.0\n", grains, with("diameter_spread = 0.1\n", ""));
    text = with("height = \"12 mm\"\n", height,
                with("restitution = 0.5\n", "restitution = 0.5\n" + trough, text));
    return with("max_cycles = 200\n", "", text) + below;
}

std::string const a_screen = "[screen]\nopening = \"5 mm\"\nwire = \"1 mm\"\ntime = \"2 s\"\n";
std::string const a_feed = "[feed]\nmass_flow = \"0.1 t/h\"\n";
std::string const a_cube = "shape = \"cube\"\n";
std::string const a_point = "block = \"point\"\n";
std::string const smooth_walls = "side_wall_friction = 0\n";
std::string const some_fines = "[[materials]]\nname = \"fines\"\nmass_fraction = 0.2\n";
std::string const a_stage = "[[stages]]\ncycles = 20\n";

std::string measured(std::string const& line, std::string const& below) {
    return with("confidence", line + "\nconfidence", case_with(below));
}

std::string filmed(std::string text) {
    return with("frames_per_cycle = 0", "frames_per_cycle = 10\ncontacts = true", std::move(text));
}

std::string stage_with(std::string const& lines) {
    return case_with(a_stage + lines);
}

TEST(Pairs, WhatDoesNotGoTogetherIsRefused) {
    std::vector<Refusal> const refusals{
        {case_with(a_screen, smooth_walls), "trough.side_wall_friction", "screen.opening"},
        {case_with(a_screen, "", a_cube), "grains.shape", "screen.opening"},
        {case_with(a_screen, "", "", a_point), "layer.block", "screen.opening"},
        {case_with(a_screen + some_fines), "materials.1.name", "screen.opening"},
        {case_with(a_screen + a_stage), "stages.1.cycles", "screen.opening"},
        {filmed(case_with(a_screen)), "output.contacts", "screen.opening"},
        {case_with(a_feed + a_screen, smooth_walls, "", ""), "screen.time", "feed.mass_flow"},
        {case_with(a_feed, smooth_walls, a_cube, ""), "grains.shape", "feed.mass_flow"},
        {filmed(case_with(a_feed, smooth_walls, "", "")), "output.contacts", "feed.mass_flow"},
        {case_with("", "", a_cube, a_point), "grains.shape", "layer.block"},
        {case_with("", "", "diameter_spread = 0.1\n", a_point), "grains.diameter", "layer.block"},
        {case_with(some_fines, "", "", a_point), "materials.1.name", "layer.block"},
        {case_with("[engine]\ncontact = \"hooke\"\n", "", "", a_point), "engine.contact", "layer.block"},
        {case_with("[engine]\ncohesion = \"1 J/m3\"\n", "", "", a_point), "engine.cohesion", "layer.block"},
        {filmed(case_with("", "", "", a_point)), "output.contacts", "layer.block"},
        {filmed(case_with("", "", a_cube)), "output.contacts", "grains.shape"},
        {case_with(some_fines, "", a_cube), "materials.1.name", "grains.shape"},
        {case_with("", "", a_cube + "diameter_spread = 0.1\n"), "grains.diameter", "grains.shape"},
        {case_with("", "", a_cube + "rotation = \"rolling\"\nrolling_friction = 0.1\n"), "grains.rotation",
         "grains.shape"},
        {case_with("", smooth_walls + "width = \"1 m\"\n"), "trough.width", "trough.side_wall_friction"},
        {measured("max_cycles = 50", a_stage), "measure.max_cycles", "stages.1.cycles"},
        {measured("max_packings = 9", a_stage), "measure.max_packings", "stages.1.cycles"},
        {measured("min_cycles = 50", a_screen), "measure.min_cycles", "screen.opening"},
        {measured("max_core_time = \"1 h\"", a_screen), "measure.max_core_time", "screen.opening"},
        {stage_with("time = \"2 s\"\n"), "stages.1.time", "cycles"},
        {stage_with("throw_number = 2\nfrequency = \"9 Hz\"\n"), "stages.1.frequency", "throw_number"},
        {stage_with("standstill = true\namplitude = \"3 mm\"\n"), "stages.1.amplitude", "standstill"},
    };
    for (auto const& [text, key, other] : refusals)
        EXPECT_THAT(error_of(text), testing::HasSubstr(fmt::format("{}: does not go with {}: ", key, other)))
            << text;
}

TEST(Pairs, WhatNeedsSomethingElseSaysSo) {
    std::vector<Refusal> const refusals{
        {case_with(a_feed, "", "", ""), "feed.mass_flow", "trough.side_wall_friction"},
        {case_with("[feed]\nwidth = \"15 mm\"\n"), "feed.width", "feed.mass_flow"},
        {case_with("[screen]\nopening = \"5 mm\"\ntime = \"2 s\"\n"), "screen.opening", "screen.wire"},
        {case_with("[screen]\nopening = \"5 mm\"\nwire = \"1 mm\"\n"), "screen.opening", "screen.time"},
        {case_with("[screen]\nwire = \"1 mm\"\n"), "screen.wire", "screen.opening"},
        {case_with("", "mesh_unit = \"m\"\n"), "trough.mesh_unit", "trough.mesh"},
        {case_with("", "", "number_fractions = [1]\n"), "grains.number_fractions", "grains.diameters"},
        {case_with("", "", "rotation = \"rolling\"\n"), "grains.rotation", "grains.rolling_friction"},
        {case_with("", "", "rolling_friction = 0.1\n"), "grains.rolling_friction", "grains.rotation"},
        {with("youngs_modulus = \"5 MPa\"\n", "", case_with("[engine]\ncohesion = \"1 J/m3\"\n")),
         "engine.cohesion", "grains.youngs_modulus"},
        {with("frames_per_cycle = 0", "contacts = true", case_with("")), "output.contacts",
         "output.frames_per_cycle"},
    };
    for (auto const& [text, key, other] : refusals)
        EXPECT_THAT(error_of(text), testing::HasSubstr(fmt::format("{}: needs {}: ", key, other))) << text;
}

// The examples that the table changes are right without the change.
TEST(Pairs, WhatGoesTogetherIsTaken) {
    EXPECT_EQ(error_of(case_with("")), "no error");
    EXPECT_EQ(error_of(case_with(a_screen)), "no error");
    EXPECT_EQ(error_of(case_with(a_stage)), "no error");
    EXPECT_EQ(error_of(case_with(some_fines)), "no error");
    EXPECT_EQ(error_of(case_with("", "", a_cube)), "no error");
    EXPECT_EQ(error_of(case_with("", "", "", a_point)), "no error");
    EXPECT_EQ(error_of(with("36 mm", "200 mm", case_with(a_feed, smooth_walls, "", ""))), "no error");
}

}  // namespace
}  // namespace vibrotrough
