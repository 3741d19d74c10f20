#include "learn/campaign_trend.hpp"

#include "atlas/tables.hpp"
#include "atlas/value.hpp"
#include "learn/synthetic_campaign.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

/// The trend of a campaign file over its domain.
CampaignTrend trend_of(std::string const& text) {
    SyntheticCampaign const campaign(text);
    return {*campaign.maker, campaign_points(campaign.plan, *campaign.maker).inputs, {}};
}

/// A place of the trend, whose inputs may come in any order.
atlas::Place place_in(CampaignTrend const& trend, double gamma, double other) {
    atlas::Place place;
    for (atlas::SurfaceInput const& input : trend.inputs())
        place.push_back(input.key == "trough.throw_number" ? gamma : other);
    return place;
}

// The nine numbers of the example: 6 mm over 3 mm, a layer of 12 mm, 30 degrees on the level.
atlas::Place atlas_place(double gamma, double rolling) {
    return {gamma, std::tan(std::acos(-1.0) / 6), 0, 0.23, 2, 4, 0.5, rolling, 0.5};
}

TEST(CampaignTrend, OfSpheresIsTheAtlas) {
    CampaignTrend const trend = trend_of(domain_campaign);
    EXPECT_TRUE(trend.is_atlas());
    // The mean diameter of a spread differs from the one given by less than a percent, and its efficiency
    // much less.
    EXPECT_NEAR(*trend.efficiency_at(place_in(trend, 1.7, 0.1)), *atlas::efficiency_at(atlas_place(1.7, 0.1)),
                1e-3);
    // Beyond the range of the rolling friction, which ends at 0.2, it goes on as it is there.
    EXPECT_EQ(*trend.efficiency_at(place_in(trend, 1.7, 0.3)),
              *trend.efficiency_at(place_in(trend, 1.7, 0.2)));
}

// Layers of another kind learn as ever, from the theory: they gain nothing and lose nothing.
TEST(CampaignTrend, OfAnotherKindIsTheTheory) {
    std::string const cubes = with("diameter_spread = 0.1", "shape = \"cube\"") +
                              "[domain]\n\"trough.throw_number\" = { from = 1, to = 3 }\n"
                              "\"trough.friction\" = { from = 0.1, to = 0.5 }\n";
    for (std::string const& text : {campaign_of_another_kind, cubes}) {
        CampaignTrend const trend = trend_of(text);
        EXPECT_FALSE(trend.is_atlas());
        EXPECT_FALSE(trend.prior().about_trend.deviation);
        EXPECT_TRUE(trend.prior().about_trend.lengths.empty());
        EXPECT_EQ(trend.prior().offset_sd, 1);
        EXPECT_EQ(trend.prior().slope_sd, 1);
        auto const place = place_in(trend, 1.7, 0.1);
        EXPECT_EQ(*trend.efficiency_at(place), *theory_of(prepare::prepare_case(trend.scenario_at(place))));
    }
}

// Side walls 6 diameters apart in one corner of the domain, 30 in another: the trend must be one function.
TEST(CampaignTrend, OfADomainThatChangesTheKindIsTheTheory) {
    auto const text =
        with("friction = 0.23", "side_wall_friction = 0.3\nfriction = 0.23", domain_campaign) + "[engine]\n";
    std::string const walls =
        with("[domain]\n", "[domain]\n\"layer.width\" = { from = \"18 mm\", to = \"90 mm\" }\n", text);
    EXPECT_FALSE(trend_of(walls).is_atlas());
}

// The difference from the atlas has its size, and 0.7 of the lengths of its own process at most: what so few
// points cannot show is taken from the atlas. Its lengths there belong to the ranges of the atlas.
TEST(CampaignTrend, OfTheAtlasBringsItsPrior) {
    CampaignTrend const trend = trend_of(domain_campaign);
    auto const prior = trend.prior();
    EXPECT_EQ(prior.about_trend.deviation.value().median, 0.03);
    EXPECT_EQ(prior.least_deviation, 0.02);
    EXPECT_EQ(prior.offset_sd, 0.05);
    EXPECT_EQ(prior.slope_sd, 0.2);
    auto const lengths = atlas::error_lengths();
    for (std::size_t k = 0; k < 2; ++k) {
        auto const& input = trend.inputs()[k];
        auto const in_atlas =
            input.key == "trough.throw_number" ? atlas::throw_number_input : atlas::rolling_friction_input;
        auto const& range = atlas::inputs()[in_atlas];
        double const length = lengths[in_atlas] * (range.high - range.low);
        EXPECT_NEAR(prior.longest[k] * (input.high - input.low), 0.7 * length, 0.01 * length);
        EXPECT_EQ(prior.about_trend.lengths[k].value().median, prior.longest[k]);
    }
}

// Of an input that the atlas does not have, such as the spread of the diameters, nothing is known: least of
// all that a surface is smooth along it.
TEST(CampaignTrend, OfTheAtlasKnowsNothingOfOtherInputs) {
    auto const prior =
        trend_of(domain_campaign + "\"grains.diameter_spread\" = { from = 0.05, to = 0.15 }\n").prior();
    ASSERT_EQ(prior.about_trend.lengths.size(), 3U);
    EXPECT_EQ(std::ranges::count(prior.longest, atlas::usual_longest_length), 1);
    auto const is_unknown = [](auto const& length) { return !length; };
    EXPECT_EQ(std::ranges::count_if(prior.about_trend.lengths, is_unknown), 1);
}

}  // namespace
}  // namespace vibrotrough::learn
