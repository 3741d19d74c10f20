#include "scenario/reader/swept_keys.hpp"

#include "example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough::scenario {
namespace {

Campaign campaign_with(std::string const& lines) {
    return parse_campaign(example_campaign + lines, "c.toml");
}

std::vector<std::string_view> paths(SweptKeys const& keys) {
    std::vector<std::string_view> names;
    for (Key const* const key : keys) names.push_back(key->path);
    return names;
}

// Every key that may be swept has a value in every case, or none because the case has nothing of the kind.
TEST(SweptKeys, EveryKeyOfOneValueIsKnown) {
    Scenario scenario = campaign_with("").cases.front();
    scenario.trough.side_wall_friction = 0.1;
    scenario.trough.waveform = std::make_shared<Waveform>();
    scenario.trough.waveform_order = 3;
    TroughMesh mesh{};
    mesh.files = {{"vee.stl", ""}};
    scenario.trough.mesh = std::make_shared<TroughMesh>(mesh);
    scenario.measure.max_core_time = 1;
    scenario.measure.min_cycles = 1;
    scenario.feed = {0.1, 0.02, 0.01, 0.04};
    scenario.screen = {0.005, 0.001, 2.0};
    for (Key const& key : all_keys()) {
        if (can_vary(key) && !is_list_section(key.path.substr(0, key.path.find('.')))) {
            EXPECT_TRUE(key_value(scenario, key.path)) << key.path;
        }
    }
    EXPECT_FALSE(key_value(scenario, "grains.diameters"));
    EXPECT_FALSE(key_value(scenario, "no.key"));
}

TEST(SweptKeys, ValuesAreGivenOrDerived) {
    Scenario const s = campaign_with("").cases.front();
    EXPECT_EQ(key_value(s, "trough.throw_number"), Content(2.0));
    EXPECT_EQ(key_value(s, "trough.stroke"), Content(0.012));
    EXPECT_EQ(key_value(s, "grains.rotation"), Content("free"));
    EXPECT_EQ(key_value(s, "layer.block"), Content("none"));
    EXPECT_FALSE(key_value(s, "trough.side_wall_friction"));
    // tan(30 deg); rounding of the angle.
    EXPECT_NEAR(std::get<double>(*key_value(s, "trough.tan_vibration_angle")), 1 / std::sqrt(3), 1e-15);
}

// Sweeps, zips, points and samples are swept keys, the keys of a list by name; what has the same value in all
// cases is not.
TEST(SweptKeys, AreThoseThatDiffer) {
    EXPECT_TRUE(campaign_with("").swept.empty());
    EXPECT_EQ(
        paths(campaign_with("[sweep]\n\"trough.throw_number\" = [1.5, 2.0]\n"
                            "\"trough.friction\" = [0.3]\n[zip]\n\"grains.rotation\" = [\"free\", "
                            "\"rolling\"]\n\"grains.rolling_friction\" = [0, 0.05]\n")
                  .swept),
        (std::vector<std::string_view>{"trough.throw_number", "grains.rolling_friction", "grains.rotation"}));
    EXPECT_EQ(
        paths(campaign_with("[sample]\nmethod = \"sobol\"\ncount = 4\n\"layer.height\" = { from = \"6 mm\", "
                            "to = \"12 mm\" }\n")
                  .swept),
        (std::vector<std::string_view>{"layer.height"}));
}

TEST(SweptKeys, LabelsAreInTheUnitsOfPeople) {
    Campaign const campaign = campaign_with(
        "[sweep]\n\"trough.stroke\" = [\"8 mm\", \"12 mm\"]\n\"trough.inclination\" = [\"0 deg\", "
        "\"-3 deg\"]\n\"grains.friction\" = [0.3, 0.5]\n\"grains.youngs_modulus\" = [\"5 MPa\", "
        "\"10 MPa\"]\n");
    EXPECT_EQ(swept_label(campaign.cases.back(), campaign.swept),
              "stroke 12 mm, inclination -3 deg, grains.friction 0.5, grains.youngs_modulus 10 MPa");
    EXPECT_EQ(swept_label(campaign.cases.front(), {}), "");
    EXPECT_EQ(written_value(*find_key("grains.rotation"), Content("rolling")), "rolling");
    EXPECT_EQ(written_value(*find_key("grains.density"), Content(1400.0)), "1400 kg/m3");
}

}  // namespace
}  // namespace vibrotrough::scenario
