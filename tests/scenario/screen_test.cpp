#include "example_campaign.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

using testing::HasSubstr;

/// The example on a screen: its layer is 36 mm x 18 mm.
std::string screened(std::string const& lines = "opening = \"5 mm\"\nwire = \"1 mm\"\ntime = \"2 s\"\n",
                     std::string const& base = with("max_cycles = 200", "")) {
    return base + "\n[screen]\n" + lines;
}

TEST(Screen, HasTheLengthThatItIsGiven) {
    auto const one = single_case(screened());
    EXPECT_TRUE(has_given_length(one));
    EXPECT_DOUBLE_EQ(*one.screen.opening, 0.005);
    EXPECT_DOUBLE_EQ(*one.screen.wire, 0.001);
    EXPECT_EQ(one.screen.time, 2.0);
    EXPECT_EQ(one.measure.max_cycles, std::lround(2 * one.trough.frequency));
    EXPECT_EQ(one.measure.max_packings, one.measure.packings);
    std::string const text = to_toml(one);
    EXPECT_EQ(to_toml(single_case(text)), text);
    EXPECT_FALSE(has_given_length(single_case(example_campaign)));
}

TEST(Screen, HolesAreNotCutByTheBox) {
    EXPECT_THAT(error_of(screened("opening = \"4 mm\"\nwire = \"1 mm\"\ntime = \"2 s\"\n")),
                HasSubstr("write \"35 mm\" or \"40 mm\""));
    EXPECT_EQ(error_of(screened("opening = \"0 mm\"\nwire = \"1.1 mm\"\ntime = \"2 s\"\n")), "no error");
    EXPECT_THAT(error_of(screened("opening = \"5.9 mm\"\nwire = \"0.1 mm\"\ntime = \"2 s\"\n")),
                HasSubstr("screen.wire: 0.1 mm is less than a twentieth of the opening"));
}

TEST(Screen, NeedsAllItsKeys) {
    EXPECT_THAT(error_of(screened("opening = \"5 mm\"\nwire = \"1 mm\"\n")),
                HasSubstr("screen.time is missing"));
    EXPECT_THAT(error_of(screened("wire = \"1 mm\"\ntime = \"2 s\"\n")),
                HasSubstr("screen.wire: there is no screen"));
}

std::string fed_screen(std::string const& screen, std::string const& length = "60 mm") {
    std::string const base = with("length = \"36 mm\"", "length = \"" + length + "\"",
                                  with("restitution = 0.5", "restitution = 0.5\nside_wall_friction = 0",
                                       with("height = \"12 mm\"", "")));
    return base + "\n[feed]\nmass_flow = \"0.1 t/h\"\nlength = \"15 mm\"\n[screen]\n" + screen;
}

// A screen that is fed has as long as it takes: its rounds are those of an open trough, and the holes begin
// behind the feed, which needs no whole number of pitches.
TEST(Screen, MayBeFed) {
    auto const one = single_case(fed_screen("opening = \"5 mm\"\nwire = \"1 mm\"\n"));
    EXPECT_TRUE(is_fed_screen(one));
    EXPECT_FALSE(has_given_length(one));
    EXPECT_EQ(one.measure.max_cycles, 200);
    double const plate = one.layer.length - holes_along(one) * 0.006;
    EXPECT_GT(plate, 0.015 + largest_excursion(drive_motion(one.trough)));
    EXPECT_LT(plate, 0.015 + largest_excursion(drive_motion(one.trough)) + largest_diameter(one) + 0.006);
    std::string const text = to_toml(one);
    EXPECT_EQ(to_toml(single_case(text)), text);
    EXPECT_EQ(holes_along(single_case(fed_screen("opening = \"0 mm\"\nwire = \"1 mm\"\n"))), 0);
}

TEST(Screen, OnlyABatchHasATime) {
    std::string const holes = "opening = \"5 mm\"\nwire = \"1 mm\"\n";
    EXPECT_THAT(error_of(fed_screen(holes + "time = \"2 s\"\n")), HasSubstr("screen.time: grains are fed"));
    EXPECT_THAT(error_of(fed_screen("opening = \"5 mm\"\nwire = \"1.1 mm\"\n")),
                HasSubstr("a side wall would cut through holes"));
    EXPECT_THAT(error_of(fed_screen("opening = \"17 mm\"\nwire = \"1 mm\"\n", "36 mm")),
                HasSubstr("there is no room for a hole"));
}

// What does not go together is refused by its name.
TEST(Screen, RefusesWhatItCannotHave) {
    std::string const whole = "opening = \"5 mm\"\nwire = \"1 mm\"\ntime = \"2 s\"\n";
    std::string const plain = with("max_cycles = 200", "");
    EXPECT_THAT(error_of(screened(whole, example_campaign)),
                HasSubstr("measure.max_cycles: how long a run is"));
    EXPECT_THAT(error_of(screened(
                    whole, with("restitution = 0.5", "restitution = 0.5\nside_wall_friction = 0", plain))),
                HasSubstr("trough.side_wall_friction: "));
    EXPECT_THAT(error_of(screened(whole) + "\n[[materials]]\nname = \"fines\"\nmass_fraction = 0.2\n"),
                HasSubstr("materials.1.name: "));
    EXPECT_THAT(error_of(screened(whole) + "\n[[stages]]\ncycles = 20\n"), HasSubstr("stages.1.cycles: "));
}

}  // namespace
}  // namespace vibrotrough
