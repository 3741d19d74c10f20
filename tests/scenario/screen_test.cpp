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

TEST(Screen, AFedOneHasRoomForHoles) {
    EXPECT_THAT(error_of(fed_screen("opening = \"5 mm\"\nwire = \"1.1 mm\"\n")),
                HasSubstr("a side wall would cut through holes"));
    EXPECT_THAT(error_of(fed_screen("opening = \"17 mm\"\nwire = \"1 mm\"\n", "36 mm")),
                HasSubstr("there is no room for a hole"));
}

}  // namespace
}  // namespace vibrotrough
