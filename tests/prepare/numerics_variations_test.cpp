#include "prepare/numerics_variations.hpp"

#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough::prepare {
namespace {

VariedSetting const& find(std::vector<VariedSetting> const& all, NumericalSetting setting) {
    return *std::find_if(all.begin(), all.end(), [&](auto const& one) { return one.setting == setting; });
}

// Written as a campaign and read back, every variation differs from the case in exactly its own key.
TEST(NumericsVariations, EachChangesOneKey) {
    PreparedCase const base = prepare_case(scenario_of(example_campaign));
    std::vector<scenario::Scenario> all{base.scenario};
    std::vector<std::string_view> keys{""};
    for (VariedSetting const& setting : vary_numerics(base)) {
        EXPECT_TRUE(setting.left_out.empty());
        for (NumericalVariation const& one : setting.variations) {
            all.push_back(one.scenario);
            keys.emplace_back(key_of(setting.setting));
        }
    }
    ASSERT_EQ(all.size(), 6u);
    auto const read = scenario::parse_campaign(scenario::campaign_toml(all, "test"), "test.toml").cases;
    ASSERT_EQ(read.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(to_toml(read[i]), to_toml(all[i]));
        auto const names = scenario::differing_keys({keys_of(read[0]), keys_of(read[i])});
        EXPECT_EQ(names, i == 0 ? std::set<std::string_view>{} : std::set{keys[i]});
    }
}

// Contact time and overlap at impact are proportional to E^(-2/5): 4^(-0.4) = 0.574, 16^(-0.4) = 0.330.
TEST(NumericsVariations, CoarsenessOfTheModulusIsThatOfAContact) {
    auto const all = vary_numerics(prepare_case(scenario_of(example_campaign)));
    VariedSetting const& modulus = find(all, NumericalSetting::youngs_modulus);
    ASSERT_EQ(modulus.variations.size(), 2u);
    EXPECT_EQ(modulus.value, 5e6);
    EXPECT_EQ(modulus.order, 1);
    EXPECT_EQ(modulus.variations[0].value, 20e6);
    EXPECT_NEAR(modulus.variations[0].coarseness, 0.5743, 5e-5);
    EXPECT_EQ(modulus.variations[1].value, 80e6);
    EXPECT_NEAR(modulus.variations[1].coarseness, 0.3299, 5e-5);
}

// Steps per cycle are a multiple of 100, so that the step is at most half as long and at least 100 steps off.
TEST(NumericsVariations, HalvesTheTimeStepThatIsReallyUsed) {
    for (char const* const asked : {"", "\n[solver]\nrayleigh_fraction = 0.5\n"}) {
        PreparedCase const base = prepare_case(scenario_of(example_campaign + asked));
        auto const all = vary_numerics(base);
        VariedSetting const& step = find(all, NumericalSetting::time_step);
        ASSERT_EQ(step.variations.size(), 1u);
        int const steps = prepare_case(step.variations[0].scenario).time.steps_per_cycle;
        EXPECT_GE(steps, 2 * base.time.steps_per_cycle);
        EXPECT_LE(steps, 2 * base.time.steps_per_cycle + 100);
    }
}

// Twice the floor, the same height: twice the grains, whether height or grains were given.
TEST(NumericsVariations, DoublesTheBoxAtTheSameHeight) {
    for (std::string const& text : {example_campaign, with("height = \"12 mm\"", "grains = 360")}) {
        PreparedCase const base = prepare_case(scenario_of(text));
        auto const all = vary_numerics(base);
        for (auto const setting : {NumericalSetting::length, NumericalSetting::width}) {
            VariedSetting const& box = find(all, setting);
            ASSERT_EQ(box.variations.size(), 1u);
            scenario::Scenario const read =
                scenario::parse_campaign(to_toml(box.variations[0].scenario), "t").cases.front();
            PreparedCase const larger = prepare_case(read);
            // The number of grains is rounded.
            EXPECT_NEAR(larger.scenario.layer.grains, 2 * base.scenario.layer.grains, 1);
            EXPECT_NEAR(larger.layer_height, base.layer_height, 0.01 * base.layer_height);
            EXPECT_EQ(box.variations[0].value, 2 * box.value);
        }
    }
}

TEST(NumericsVariations, LeavesOutTheWidthBetweenSideWalls) {
    auto const all = vary_numerics(
        prepare_case(scenario_of(with("friction = 0.23", "friction = 0.23\nside_wall_friction = 0.2"))));
    VariedSetting const& width = find(all, NumericalSetting::width);
    EXPECT_TRUE(width.variations.empty());
    EXPECT_NE(width.left_out.find("side walls"), std::string::npos);
    EXPECT_EQ(find(all, NumericalSetting::length).variations.size(), 1u);
}

TEST(NumericsVariations, OfABlockAreThoseOfItsContact) {
    std::string const text =
        with("height = \"12 mm\"", "block = \"point\"", with("diameter_spread = 0.1\n", ""));
    auto const all = vary_numerics(prepare_case(scenario_of(text)));
    VariedSetting const& stiffness = find(all, NumericalSetting::block_stiffness);
    ASSERT_EQ(stiffness.variations.size(), 2u);
    EXPECT_EQ(stiffness.variations[0].value, 600);
    EXPECT_EQ(stiffness.variations[1].value, 1200);
    EXPECT_EQ(stiffness.variations[1].coarseness, 0.25);
    for (VariedSetting const& one : all) {
        if (one.setting == NumericalSetting::block_stiffness) continue;
        EXPECT_TRUE(one.variations.empty());
        EXPECT_FALSE(one.left_out.empty()) << name_of(one.setting);
    }
}

// A variation that the keys do not allow is left out and named, so that the study is never refused.
TEST(NumericsVariations, KeepToTheRangesOfTheKeys) {
    auto const stiff = vary_numerics(
        prepare_case(scenario_of(with("youngs_modulus = \"5 MPa\"", "youngs_modulus = \"100 GPa\""))));
    EXPECT_EQ(find(stiff, NumericalSetting::youngs_modulus).variations.size(), 1u) << "400 GPa, not 1600";
    auto const stiffest = vary_numerics(
        prepare_case(scenario_of(with("youngs_modulus = \"5 MPa\"", "youngs_modulus = \"1 TPa\""))));
    EXPECT_FALSE(find(stiffest, NumericalSetting::youngs_modulus).left_out.empty());
    auto const fine = vary_numerics(
        prepare_case(scenario_of(example_campaign + std::string("\n[solver]\nrayleigh_fraction = 0.015\n"))));
    EXPECT_FALSE(find(fine, NumericalSetting::time_step).left_out.empty());
}

}  // namespace
}  // namespace vibrotrough::prepare
