#include "deck/deck.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The drive's deck of the example as an open trough of 200 mm that is fed with 36 g/s.
std::string open_deck(std::string const& sections, std::string const& feed = "", int packing = 1) {
    std::string const trough = with("restitution = 0.5", "restitution = 0.5\nside_wall_friction = 0",
                                    with("height = \"12 mm\"", "", with("36 mm", "200 mm")));
    std::string const base =
        sections.find("[[stages]]") == 0 ? with("max_cycles = 200\n", "", trough) : trough;
    std::string const text = base + "\n[feed]\nmass_flow = \"36 g/s\"\n" + feed + sections;
    auto const prepared = prepare::prepare_case(scenario::parse_campaign(text, "test.toml").cases.front());
    return make_deck(prepared, {packing}).files.at(drive_file);
}

TEST(OpenDeck, WithoutStagesHasOneFeed) {
    std::string const deck = open_deck("");
    EXPECT_THAT(deck, HasSubstr("fix             feed all insert/rate/region"));
    EXPECT_THAT(deck, HasSubstr("variable        fed equal f_feed[1]\n"));
    EXPECT_THAT(deck, HasSubstr("particles INF massrate 0.036"));
    EXPECT_THAT(deck, Not(HasSubstr("ended")));
    EXPECT_THAT(deck, HasSubstr(" 0 0.018"));  // the stream is as wide as the trough
}

TEST(OpenDeck, ANarrowStreamIsInTheMiddle) {
    std::string const deck = open_deck("", "width = \"14 mm\"\n");
    EXPECT_THAT(deck,
                testing::ContainsRegex("feed_zone block [^ ]+ [^ ]+ 0.00(2|1999)[0-9]* 0.01(6|5999)[0-9]* "));
}

// Ramp and stage with one frequency are one feed, the stage without feed has none, and the last one begins
// behind 6 + 3 cycles. A feed counts its grains with its own time step.
TEST(OpenDeck, StagesOfOneFeedAreTogether) {
    std::string const deck = open_deck(
        "[[stages]]\ncycles = 6\nramp_cycles = 2\nfrequency = \"20 Hz\"\n"
        "[[stages]]\ncycles = 3\nmass_flow = \"0 t/h\"\n"
        "[[stages]]\ncycles = 4\nfrequency = \"10 Hz\"\nmass_flow = \"18 g/s\"\n");
    EXPECT_THAT(deck, HasSubstr("fix             feed_1 all"));
    EXPECT_THAT(deck, HasSubstr("fix             feed_2 all"));
    EXPECT_THAT(deck, Not(HasSubstr("feed_3")));
    EXPECT_THAT(deck, HasSubstr("variable        fed_mass equal 0+f_feed_1[2]+f_feed_2[2]\n"));
    EXPECT_THAT(deck, HasSubstr("*((v_ended>0)*(v_ended-0)-(v_ended>6)*(v_ended-6))+"));
    EXPECT_THAT(deck, HasSubstr("*((v_ended>9)*(v_ended-9)-(v_ended>13)*(v_ended-13))-v_fed\n"));
    EXPECT_THAT(deck, HasSubstr("+0.1*((v_ended>9)*(v_ended-9)-(v_ended>13)*(v_ended-13))\n"));
    EXPECT_THAT(deck,
                HasSubstr("variable        rate equal 0.0018"));  // 36 g/s for 50 ms and 18 g/s for 100 ms
    EXPECT_THAT(deck, HasSubstr("variable        cycle_time equal 0+(0.05)*(${done}>=0)"));
    EXPECT_THAT(deck, HasSubstr("equal (1>v_now)*1+(1<=v_now)*2000000000\n"));
}

// Grains that are fed are in no group: materials are told by their type.
TEST(OpenDeck, MaterialsAreToldByTheirType) {
    std::string const deck =
        open_deck("[[materials]]\nname = \"fines\"\nmass_fraction = 0.25\ndiameter = \"2 mm\"\n");
    EXPECT_THAT(deck, HasSubstr("variable        mass_1 atom mass*(type==4)\n"));
    EXPECT_THAT(
        deck,
        HasSubstr(" density/mass vx v_mass_0 v_momentum_0 v_moment_0 v_mass_1 v_momentum_1 v_moment_1 "));
    EXPECT_THAT(deck, HasSubstr(" id x vx type mass\n"));
    EXPECT_THAT(deck, Not(HasSubstr("group           material")));
}

// As many feeds as there may be, in the last packing there may be: every feed has its seed.
TEST(OpenDeck, ManyFeedsHaveTheirSeeds) {
    std::string stages;
    for (int i = 0; i < 16; ++i)
        stages += fmt::format("[[stages]]\ncycles = 3\nramp_cycles = 1\nfrequency = \"{} Hz\"\n",
                              i % 2 == 0 ? 20 : 10);
    for (int const packing : {1, 1000}) EXPECT_THAT(open_deck(stages, "", packing), HasSubstr("feed_31 all"));
}

}  // namespace
}  // namespace vibrotrough::deck
