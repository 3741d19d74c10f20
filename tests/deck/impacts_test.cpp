#include "deck/impacts.hpp"

#include "deck/deck.hpp"
#include "deck/estimates.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

using testing::HasSubstr;
using testing::Not;

prepare::PreparedCase impact_case(std::string const& text) {
    return prepare::prepare_case(scenario::parse_campaign(text, "test.toml").cases.front());
}

std::string with_lines(std::string const& more) {
    return with("max_cycles = 200", "max_cycles = 200\n" + more);
}

std::string driven_deck(std::string const& text) {
    return make_deck(impact_case(text), {1}).files.at(drive_file);
}

// What is not asked for leaves no trace, and the first deck does not change.
TEST(ImpactDeck, WatchesTwoCyclesThatEveryPackingHas) {
    Deck const with_it = make_deck(impact_case(with_lines("impacts = true")), {1}),
               without = make_deck(impact_case(example_campaign), {1});
    EXPECT_EQ(with_it.settle_files, without.settle_files);
    EXPECT_THAT(without.files.at(drive_file), Not(HasSubstr("grain_contacts")));
    EXPECT_NE(digest_of(with_it.files), digest_of(without.files));
    prepare::PreparedCase const prepared = impact_case(with_lines("impacts = true"));
    auto const [from, to] = watched_cycles(prepared.scenario);
    EXPECT_EQ(to, first_round_cycles(prepared.scenario));
    EXPECT_EQ(to - from, 2);
    EXPECT_THAT(with_it.files.at(drive_file),
                HasSubstr(fmt::format("if \"${{done}} >= {} && ${{done}} < {}\" then", from, to)));
    EXPECT_GT(expected_bytes(prepared), expected_bytes(impact_case(example_campaign)));
}

// Two lists within the approach, which takes two fifths of the duration or more.
TEST(ImpactDeck, ListsTheContactsOftenEnough) {
    for (double const fraction : {0.01, 0.05, 0.075, 0.1}) {
        int const steps = steps_between_lists({1e-5, 5900, 0.2, fraction, 1});
        EXPECT_LE(steps * fraction, 0.2 + 1e-12) << fraction;
        EXPECT_GE(steps, 1);
        EXPECT_EQ(5900 % steps, 0);
    }
}

// The engine allows one compute of each kind, whose columns come in its own order.
TEST(ImpactDeck, SharesTheContactsWithOtherOutputs) {
    std::string const impacts = driven_deck(with_lines("impacts = true"));
    EXPECT_THAT(impacts, HasSubstr("overlaps all pair/gran/local id delta\n"));
    EXPECT_THAT(impacts, HasSubstr("reduce max c_overlaps[4]\n"));
    EXPECT_THAT(impacts, HasSubstr("floor_contacts all wall/gran/local id delta\n"));
    EXPECT_THAT(
        impacts,
        HasSubstr("c_floor_contacts[1] c_floor_contacts[2] c_floor_contacts[3] c_floor_contacts[4]\""));
    std::string const both = driven_deck(with_lines("impacts = true\nrolling = true"));
    EXPECT_THAT(both, HasSubstr("floor_contacts all wall/gran/local id torque delta\n"));
    EXPECT_THAT(both, HasSubstr("reduce sum c_floor_contacts[5]\n"));
    EXPECT_THAT(both, HasSubstr("c_floor_contacts[3] c_floor_contacts[7]\""));
    std::string const rolling = driven_deck(with_lines("rolling = true"));
    EXPECT_THAT(rolling, HasSubstr("floor_contacts all wall/gran/local torque\n"));
    EXPECT_THAT(rolling, HasSubstr("reduce sum c_floor_contacts[2]\n"));
}

}  // namespace
}  // namespace vibrotrough::deck
