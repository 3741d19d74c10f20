#include "scenario/reader/shake_test.hpp"

#include "core/temporary_folder.hpp"
#include "example_campaign.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

class ShakeTestCampaign : public testing::Test {
  protected:
    scenario::Campaign made_from(std::string const& text) {
        std::ofstream(path) << text;
        return scenario::parse_campaign(scenario::shake_test_campaign(path, 0.67), "test.toml");
    }
    core::TemporaryFolder const folder;
    std::filesystem::path path = folder.path() / "shake.toml";
};

TEST_F(ShakeTestCampaign, ShakesTheSameLayerAlongALevelTrough) {
    scenario::Scenario const original = scenario::parse_campaign(example_campaign, "test.toml").cases.front();
    scenario::Campaign const campaign = made_from(example_campaign);
    ASSERT_EQ(campaign.cases.size(), 1u);
    scenario::Scenario const& test = campaign.cases.front();
    EXPECT_EQ(test.trough.inclination, 0);
    EXPECT_EQ(test.trough.vibration_angle, 0);
    EXPECT_NEAR(machine_number(test.trough), 0.67, 1e-12);
    EXPECT_EQ(test.trough.amplitude, original.trough.amplitude);
    EXPECT_EQ(test.trough.friction, original.trough.friction);
    EXPECT_EQ(test.layer.grains, original.layer.grains);
    EXPECT_EQ(test.measure.packings, original.measure.packings);
    EXPECT_EQ(layer_key(test), layer_key(original));
}

// Sweeps over the drive do not add cases: there is one test per layer.
TEST_F(ShakeTestCampaign, KeepsSweepsOverTheLayerOnly) {
    std::string const text = example_campaign + std::string(R"(
[sweep]
"trough.throw_number" = [1.5, 2.0]
"trough.tan_inclination" = [-0.05, 0.05]
"trough.amplitude" = ["5 mm", "7 mm"]
"trough.friction" = [0.2, 0.3]
"grains.friction" = { from = 0.4, to = 0.6, step = 0.1 }
)");
    scenario::Campaign const campaign = made_from(text);
    ASSERT_EQ(campaign.cases.size(), 6u);
    for (scenario::Scenario const& one : campaign.cases) EXPECT_EQ(one.trough.amplitude, 0.005);
    EXPECT_EQ(campaign.cases[0].trough.friction, 0.2);
    EXPECT_EQ(campaign.cases[5].trough.friction, 0.3);
    for (scenario::Scenario const& one : scenario::parse_campaign(text, "test.toml").cases) {
        auto const same = std::ranges::count_if(campaign.cases, [&](scenario::Scenario const& test) {
            return layer_key(test) == layer_key(one);
        });
        EXPECT_EQ(same, 1) << "each case has its test";
    }
}

/// The layers of a campaign, each once.
std::set<std::string> layers_of(scenario::Campaign const& campaign) {
    std::set<std::string> keys;
    for (scenario::Scenario const& one : campaign.cases) keys.insert(layer_key(one));
    return keys;
}

TEST_F(ShakeTestCampaign, FollowsEveryDesign) {
    for (std::string const design : {
             R"([zip]
"trough.throw_number" = [1.5, 2.0, 3.0]
"trough.friction" = [0.2, 0.3, 0.2]
)",
             R"([[points]]
"trough.throw_number" = 1.7
"layer.height" = "9 mm"
[[points]]
"trough.throw_number" = 2.7
"layer.height" = "9 mm"
[[points]]
"trough.throw_number" = 2.7
"layer.height" = "6 mm"
)",
             R"([sample]
method = "sobol"
count = 8
"trough.throw_number" = { from = 1, to = 3 }
"grains.friction" = { from = 0.2, to = 0.6 }
)",
             R"([sweep]
"trough.throw_number" = [1.5, 2.0]
"grains.shape" = ["sphere", "cube"]
)",
             R"([sweep]
"trough.throw_number" = [1.5, 2.0, 3.0]
"trough.friction" = [0.2, 0.3]
[[exclude]]
"trough.friction" = { above = 0.25 }
)"}) {
        // Clumps come in one size only.
        std::string const text = with("diameter_spread = 0.1", "diameter_spread = 0") + "\n" + design;
        scenario::Campaign const original = scenario::parse_campaign(text, "test.toml");
        scenario::Campaign const made = made_from(text);
        EXPECT_EQ(layers_of(made), layers_of(original)) << design;
        EXPECT_EQ(made.cases.size(), layers_of(made).size()) << "one test per layer\n" << design;
        for (scenario::Scenario const& test : made.cases) {
            EXPECT_NEAR(machine_number(test.trough), 0.67, 1e-12);
            EXPECT_EQ(test.trough.vibration_angle, 0);
        }
    }
}

// The theory by which the friction is determined afterwards is for a sinusoid along the trough.
TEST_F(ShakeTestCampaign, LeavesOutWhatTheDriveHasBesideItsSinusoid) {
    scenario::Campaign const made =
        made_from(with("throw_number = 2.0", "throw_number = 2.0\nalong_phase = \"20 deg\""));
    ASSERT_EQ(made.cases.size(), 1u);
    EXPECT_EQ(made.cases.front().trough.along_phase, 0);
    EXPECT_TRUE(made.cases.front().trough.harmonics.empty());
}

}  // namespace
}  // namespace vibrotrough
