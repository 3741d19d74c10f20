#include "scenario/model/feed.hpp"

#include "example_campaign.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

using scenario::Scenario;
using testing::HasSubstr;

/// The example as a trough of 200 mm with smooth walls and a feed.
std::string fed(std::string const& feed = "mass_flow = \"0.1 t/h\"\n",
                std::string const& trough = "side_wall_friction = 0\n") {
    std::string text = with("height = \"12 mm\"\n", "", with("36 mm", "200 mm"));
    return with("[grains]\n", trough + "[grains]\n", text) + "[feed]\n" + feed;
}

TEST(Feed, MakesTheTroughOpen) {
    EXPECT_FALSE(is_open(single_case(example_campaign)));
    Scenario const s = single_case(fed());
    EXPECT_TRUE(is_open(s));
    EXPECT_NEAR(*s.feed.mass_flow, 0.1 / 3.6, 1e-15);
    EXPECT_NEAR(feed_length(s), 0.02, 1e-15);
    // What the feed keeps in the trough: its mass over its speed.
    double const mass = s.layer.grains * mean_density(s) * mean_grain_volume(s);
    EXPECT_NEAR(mass * expected_speed(s) / (0.2 * *s.feed.mass_flow), 1, 0.01);
    EXPECT_NEAR(feed_height(s), 2 * layer_height(s) + 6 * largest_diameter(s), 1e-15);
    EXPECT_NEAR(feed_speed(s) * 0.15 * 1400 * 0.02 * 0.018, *s.feed.mass_flow, 1e-15);
}

TEST(Feed, IsWrittenAndReadBack) {
    Scenario const s = single_case(fed("mass_flow = \"0.1 t/h\"\nlength = \"25 mm\"\nheight = \"50 mm\"\n"));
    Scenario const again = single_case(to_toml(s));
    EXPECT_EQ(again.feed.mass_flow, s.feed.mass_flow);
    EXPECT_EQ(again.feed.length, s.feed.length);
    EXPECT_EQ(again.feed.height, s.feed.height);
    EXPECT_EQ(again.layer.grains, s.layer.grains);
    EXPECT_THAT(to_toml(single_case(example_campaign)), testing::Not(HasSubstr("feed")));
}

// Grains per time are of the mean mass; "grains" counts them, although the database of units has a mass of
// this name. What is written back is the mass flow.
TEST(Feed, MayCountGrains) {
    for (char const* rate : {"500 1/s", "30000 1/min", "500 grains/s", "500 grains per second"}) {
        Scenario const s = single_case(fed(std::string("mass_flow = \"") + rate + "\"\n"));
        EXPECT_NEAR(*s.feed.mass_flow / (500 * mean_density(s) * mean_grain_volume(s)), 1, 1e-12) << rate;
        EXPECT_EQ(single_case(to_toml(s)).feed.mass_flow, s.feed.mass_flow);
        EXPECT_EQ(single_case(to_toml(s)).layer.grains, s.layer.grains);
    }
    EXPECT_THAT(error_of(fed("mass_flow = \"-500 1/s\"\n")),
                HasSubstr("-500 grains per second are out of range"));
    EXPECT_THAT(error_of(fed("mass_flow = \"500 m/s\"\n")), HasSubstr("cannot be converted to kg/s"));
}

// 500 grains per second of a mixture weigh 500 times the mean mass of its grains.
TEST(Feed, OfAMixtureIsOfTheMeanGrain) {
    std::string const fines =
        "[[materials]]\nname = \"fines\"\nmass_fraction = 0.3\ndiameter = \"2 mm\"\ndensity = \"2500 "
        "kg/m3\"\n";
    Scenario const s = single_case(fed("mass_flow = \"500 1/s\"\n") + fines);
    double mass = 0;
    for (scenario::Material const& one : materials(s))
        mass += one.number_fraction * one.grains.density * mean_grain_volume(one.grains);
    EXPECT_NEAR(*s.feed.mass_flow / (500 * mass), 1, 1e-12);
    EXPECT_EQ(single_case(to_toml(s)).feed.mass_flow, s.feed.mass_flow);
}

std::string staged(std::string const& stages, std::string const& feed = fed("mass_flow = \"500 1/s\"\n")) {
    return with("max_cycles = 200\n", "", feed) + stages;
}

// What a stage does not give is as in the stage before, and in the first as in [feed].
TEST(Feed, StagesMayFeedLess) {
    Scenario const s = single_case(
        staged("[[stages]]\ncycles = 3\n[[stages]]\ncycles = 2\nstandstill = true\nmass_flow = \"0 t/h\"\n"
               "[[stages]]\ncycles = 2\n[[stages]]\ncycles = 4\nmass_flow = \"1 g/s\"\n"));
    std::vector<double> flows;
    for (scenario::Stage const& stage : stages(s)) flows.push_back(stage.mass_flow);
    EXPECT_EQ(flows, (std::vector<double>{*s.feed.mass_flow, 0, 0, 1e-3}));
    EXPECT_EQ(stages(single_case(to_toml(s))).back().mass_flow, 1e-3);
}

TEST(Feed, WrongFeedsOfStagesAreNamed) {
    EXPECT_THAT(error_of(staged("[[stages]]\ncycles = 3\nmass_flow = \"1 kg/s\"\n")),
                HasSubstr("stages.1.mass_flow: is more than feed.mass_flow"));
    EXPECT_THAT(error_of(staged("[[stages]]\ncycles = 3\nmass_flow = \"0 t/h\"\n")),
                HasSubstr("nothing is fed in any stage"));
    EXPECT_THAT(error_of(with("max_cycles = 200\n", "", example_campaign) +
                         "[[stages]]\ncycles = 3\nmass_flow = \"1 g/s\"\n"),
                HasSubstr("nothing is fed, because feed.mass_flow is not given"));
}

TEST(Feed, ANarrowStreamFallsFaster) {
    Scenario const s = single_case(fed("mass_flow = \"0.05 t/h\"\nwidth = \"15 mm\"\n"));
    EXPECT_NEAR(feed_speed(s) * 0.15 * 1400 * 0.02 * 0.015, *s.feed.mass_flow, 1e-15);
    EXPECT_EQ(single_case(to_toml(s)).feed.width, 0.015);
    for (char const* const width : {"13 mm", "19 mm"})
        EXPECT_THAT(error_of(fed(std::string("mass_flow = \"0.05 t/h\"\nwidth = \"") + width + "\"\n")),
                    HasSubstr("feed.width: "));
}

TEST(Feed, WrongInputIsToldInOneLine) {
    EXPECT_THAT(error_of(fed("length = \"25 mm\"\n")),
                HasSubstr("exactly one of height, diameters, grains, block, feed.mass_flow is needed"));
    EXPECT_THAT(error_of(example_campaign + "[feed]\nmass_flow = \"0.1 t/h\"\n"),
                HasSubstr("feed.mass_flow"));
    EXPECT_THAT(error_of(fed("mass_flow = \"3 t/h\"\n")),
                HasSubstr("does not fit through a zone of 20 mm by 18 mm"));
    EXPECT_THAT(error_of(fed("mass_flow = \"0.1 t/h\"\nlength = \"8 mm\"\n")), HasSubstr("feed.length"));
    EXPECT_THAT(error_of(fed("mass_flow = \"0.1 t/h\"\nlength = \"150 mm\"\n")),
                HasSubstr("half of the trough"));
    EXPECT_THAT(error_of(fed("mass_flow = \"0.1 t/h\"\nheight = \"5 mm\"\n")),
                HasSubstr("less than 3 of the largest diameters"));
    EXPECT_THAT(error_of(fed() + "[[materials]]\nname = \"b\"\nmass_fraction = 1e-4\n"),
                HasSubstr("fewer than one grain of 'b'"));
}

}  // namespace
}  // namespace vibrotrough
