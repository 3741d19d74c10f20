#include "deck/deck.hpp"
#include "deck/estimates.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

using testing::HasSubstr;
using testing::Not;

prepare::PreparedCase prepared_of(std::string const& text) {
    return prepare::prepare_case(scenario::parse_campaign(text, "test.toml").cases.front());
}

std::string const wearing = with("max_cycles = 200", "max_cycles = 200\nwear = true");

// What is not asked for leaves no trace. The mesh of the first deck must wear as well, because the engine
// reads it back only with the same properties.
TEST(WearDeck, WearsInBothDecks) {
    Deck const with_it = make_deck(prepared_of(wearing), {1}),
               without = make_deck(prepared_of(example_campaign), {1});
    for (char const* const file : {settle_file, drive_file}) {
        EXPECT_THAT(with_it.files.at(file), HasSubstr("k_finnie peratomtypepair 2 1 1 1 1\n")) << file;
        EXPECT_THAT(with_it.files.at(file), HasSubstr("reference_point 0 0 0 wear finnie\n")) << file;
        EXPECT_THAT(without.files.at(file), Not(HasSubstr("wear"))) << file;
    }
    EXPECT_THAT(with_it.files.at(settle_file), Not(HasSubstr("dump ")));
    EXPECT_THAT(with_it.files.at(drive_file), HasSubstr("wear.*.vtk trough id area wear\n"));
    EXPECT_NE(digest_of(with_it.files), digest_of(without.files));
}

// With side walls and two materials there are four types of atoms; the side walls do not wear.
TEST(WearDeck, HasAConstantForEachPairOfTypes) {
    std::string text = with("restitution = 0.5", "restitution = 0.5\nside_wall_friction = 0.3", wearing);
    text += "\n[[materials]]\nname = \"fines\"\nmass_fraction = 0.2\n";
    std::string const deck = make_deck(prepared_of(text), {1}).files.at(drive_file);
    EXPECT_THAT(deck, HasSubstr("k_finnie peratomtypepair 4 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1\n"));
    EXPECT_THAT(deck, HasSubstr("file left.stl type 3 reference_point 0 0 0\n"));
}

TEST(WearDeck, CountsItsFiles) {
    EXPECT_GT(expected_bytes(prepared_of(wearing)), expected_bytes(prepared_of(example_campaign)));
}

}  // namespace
}  // namespace vibrotrough::deck
