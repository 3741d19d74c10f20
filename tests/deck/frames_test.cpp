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

prepare::PreparedCase filmed(std::string const& lines, std::string const& text = example_campaign) {
    return prepare::prepare_case(
        scenario::parse_campaign(with("frames_per_cycle = 0", "frames_per_cycle = 10\n" + lines, text),
                                 "t.toml")
            .cases.front());
}

std::string drive_of(prepare::PreparedCase const& prepared, int packing = 1) {
    return make_deck(prepared, {packing}).files.at(drive_file);
}

TEST(FramesDeck, TheNamedPackingsWriteThem) {
    auto const some = filmed("frame_packings = [2, 4]"), all = filmed("frame_packings = \"all\"");
    for (int packing = 1; packing <= 5; ++packing) {
        bool const has = drive_of(some, packing).find("dump            frames") != std::string::npos;
        EXPECT_EQ(has, packing == 2 || packing == 4) << packing;
        EXPECT_THAT(drive_of(all, packing), HasSubstr("dump            frames"));
    }
}

// What is not asked for leaves no trace; what is asked for changes only the computes that it shares.
TEST(FramesDeck, ContactsAreAddedAtTheEnd) {
    std::string const off = drive_of(filmed("")), on = drive_of(filmed("contacts = true"));
    EXPECT_THAT(off, Not(HasSubstr("contacts.*.dump")));
    EXPECT_THAT(off, HasSubstr("compute         overlaps all pair/gran/local delta\n"));
    EXPECT_THAT(on, Not(HasSubstr("{{")));
    std::string rest = on;
    auto const begin = rest.find("# --- contacts:"), end = rest.find("# --- cycles:");
    ASSERT_NE(begin, std::string::npos);
    rest.erase(begin, end - begin);
    rest.replace(rest.find("pos id force_normal force_tangential delta"), 42, "delta");
    rest.replace(rest.find("c_overlaps[16]"), 14, "c_overlaps[1]");
    EXPECT_EQ(rest, off);
    EXPECT_EQ(make_deck(filmed("contacts = true"), {1}).settle_files,
              make_deck(filmed(""), {1}).settle_files);
    EXPECT_THAT(drive_of(filmed("contacts = true"), 2), Not(HasSubstr("# --- contacts:")));
}

TEST(FramesDeck, EstimatesCountPackingsAndContacts) {
    double const one = bytes_of(filmed(""), 4, 24), all = bytes_of(filmed("frame_packings = \"all\""), 4, 24);
    auto const none =
        prepare::prepare_case(scenario::parse_campaign(example_campaign, "t.toml").cases.front());
    double const without = bytes_of(none, 4, 24);
    EXPECT_NEAR((all - without) / (one - without), 4, 1e-9);
    EXPECT_GT(bytes_of(filmed("contacts = true"), 4, 24) - without, 2 * (one - without));
    EXPECT_NEAR(bytes_of(filmed("frame_packings = [9]"), 4, 24), without, 1e-6);
}

}  // namespace
}  // namespace vibrotrough::deck
