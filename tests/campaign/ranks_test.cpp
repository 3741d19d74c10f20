#include "campaign/execute/ranks.hpp"

#include "deck/deck.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough::campaign {
namespace {

scenario::Scenario with_grains(int grains) {
    scenario::Scenario scenario = scenario::parse_campaign(example_campaign, "campaign.toml").cases.front();
    scenario.layer.grains = grains;
    return scenario;
}

// The table of src/manual/costs.md: times on one rank over twice those on two, of which the code has two
// digits.
TEST(Ranks, EfficiencyIsWhatWasMeasured) {
    EXPECT_NEAR(parallel_efficiency(504 / 2.0), 0.033 / (2 * 0.026), 0.012);
    EXPECT_NEAR(parallel_efficiency(2016 / 2.0), 0.116 / (2 * 0.077), 0.012);
    EXPECT_NEAR(parallel_efficiency(5184 / 2.0), 0.264 / (2 * 0.205), 0.012);
    EXPECT_NEAR(parallel_efficiency(19872 / 2.0), 1.092 / (2 * 0.780), 0.012);
    EXPECT_EQ(parallel_efficiency(100), 0) << "nothing was measured";
    EXPECT_EQ(parallel_efficiency(1e6), 0.70);
    // Between two points: the geometric mean of the grains, the mean of the efficiencies.
    EXPECT_NEAR(parallel_efficiency(std::sqrt(252.0 * 1008)), (0.64 + 0.75) / 2, 1e-12);
}

TEST(Ranks, FollowTheGrainsThatEachRankWouldHave) {
    scenario::RunSettings const settings{};
    EXPECT_EQ(choose_ranks(settings, with_grains(500), 8), 1);
    EXPECT_EQ(choose_ranks(settings, with_grains(1999), 8), 1);
    EXPECT_EQ(choose_ranks(settings, with_grains(2000), 8), 2);
    EXPECT_EQ(choose_ranks(settings, with_grains(5000), 8), 5);
    EXPECT_EQ(choose_ranks(settings, with_grains(20'000), 8), 8);
    EXPECT_EQ(choose_ranks(settings, with_grains(20'000), 1), 1) << "no more than there are cores";
}

TEST(Ranks, AreWhatTheCampaignSays) {
    scenario::RunSettings settings{};
    settings.ranks = 3;
    EXPECT_EQ(choose_ranks(settings, with_grains(10), 1), 3);
}

TEST(Ranks, ShareOutTheFloorAndNotTheHeight) {
    deck::Deck const deck = deck::make_deck(prepare::prepare_case(with_grains(500)), {1});
    EXPECT_EQ(deck::for_ranks(deck.files, 1), deck.files);
    auto const files = deck::for_ranks(deck.files, 2);
    for (char const* name : {deck::settle_file, deck::drive_file}) {
        auto const line = files.at(name).find("\nprocessors      * * 1 ");
        ASSERT_NE(line, std::string::npos) << name;
        // The engine takes it before there is a box only.
        EXPECT_LT(line, std::min(files.at(name).find("\ncreate_box"), files.at(name).find("\nread_restart")));
    }
    EXPECT_EQ(files.at("trough.stl"), deck.files.at("trough.stl"));
}

}  // namespace
}  // namespace vibrotrough::campaign
