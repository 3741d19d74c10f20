#include "deck/rolling.hpp"

#include "deck/deck.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <numeric>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

using testing::HasSubstr;
using testing::Not;

Deck deck_of(std::string const& text) {
    return make_deck(prepare::prepare_case(scenario::parse_campaign(text, "test.toml").cases.front()), {1});
}

std::string const measured = with("max_cycles = 200", "max_cycles = 200\nrolling = true");

// What is not asked for leaves no trace, and the settled packings are shared: bytes of the first deck.
TEST(RollingDeck, AddsToTheSecondDeckOnly) {
    Deck const with_it = deck_of(measured), without = deck_of(example_campaign);
    EXPECT_EQ(with_it.settle_files, without.settle_files);
    EXPECT_EQ(digest_of(deck_of(with("max_cycles = 200", "max_cycles = 200\nrolling = false")).files),
              digest_of(without.files));
    std::string const on = with_it.files.at(drive_file), off = without.files.at(drive_file);
    EXPECT_THAT(off, Not(HasSubstr("store_force")));
    EXPECT_THAT(off, Not(HasSubstr("rolling.csv")));
    EXPECT_THAT(on, HasSubstr("meshes trough store_force yes limitForce"));
    EXPECT_THAT(on, Not(HasSubstr("{{")));
    // The rest of the deck is the same.
    std::string rest = on;
    auto const begin = rest.find("# --- rolling:"), end = rest.find("# --- cycles:");
    ASSERT_NE(begin, std::string::npos);
    rest.erase(begin, end - begin);
    rest.erase(rest.find("store_force yes "), 16);
    EXPECT_EQ(rest, off);
}

// Three has no factor in common with 100, so that a line every third hundredth reaches each phase in three
// cycles.
TEST(RollingDeck, ReachesEachPhase) {
    EXPECT_EQ(std::gcd(rolling_stride, prepare::phases_per_cycle), 1);
    auto const scenario = scenario::parse_campaign(measured, "test.toml").cases.front();
    int const steps = prepare::prepare_case(scenario).time.steps_per_cycle;
    std::string const deck = deck_of(measured).files.at(drive_file);
    EXPECT_THAT(deck, HasSubstr(fmt::format("floor_lines all print {} \"${{now}},${{rolling_loaded}}",
                                            3 * steps / 100)));
    EXPECT_THAT(deck, HasSubstr("z<v_base+0.003\n"));
    EXPECT_THAT(deck, HasSubstr("(z<v_base+0.006)\n"));
    // (mu (1 - 1e-6))^2
    EXPECT_THAT(deck, HasSubstr(">=0.05289989420005"));
}

// The clearing of the floor's forces by the contact compute comes after they were read.
TEST(RollingDeck, ReadsTheForcesBeforeTheyAreCleared) {
    std::string const deck = deck_of(measured).files.at(drive_file);
    EXPECT_THAT(deck, HasSubstr(",${rolling_floor_z},${rolling_floor_torque}\" append rolling.csv"));
    EXPECT_THAT(deck, HasSubstr("variable        rolling_floor_torque equal c_floor_torque\n"));
    EXPECT_THAT(deck, HasSubstr("variable        rolling_floor_z equal c_grains[16]\n"));
}

}  // namespace
}  // namespace vibrotrough::deck
