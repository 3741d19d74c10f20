#include "learn/design_file.hpp"

#include "core/note.hpp"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

using Json = nlohmann::ordered_json;

/// What `design --json` prints of a machine with a second best speed, as far as the page reads it.
Json design() {
    return Json::parse(R"({
        "task": {"width_m": 0.4, "bulk_density_kg_per_m3": 600, "grain_diameter_mm": 3.5, "rolling_friction": null},
        "stroke_mm": 7.76, "rpm": 960, "vibration_angle_deg": 28.35, "inclination_deg": 0, "layer_depth_mm": 22.2,
        "friction_low": 0.21, "friction_median": 0.3, "friction_high": 0.39,
        "mass_flow_wanted_t_per_h": 5, "confidence": 0.95, "probability": 0.952,
        "models": [{"model": "the rolling-layer law", "median_speed_m_per_s": 0.287, "mass_flow_t_per_h": 5.51,
                    "mass_flow_low_t_per_h": 4.91, "mass_flow_high_t_per_h": 6.11, "probability": 0.952}],
        "models_beside": [{"model": "the point mass", "median_speed_m_per_s": 0.18, "mass_flow_t_per_h": 3.5,
                           "mass_flow_low_t_per_h": null, "mass_flow_high_t_per_h": null, "probability": null}],
        "speeds_compared": [
            {"rank": 1, "stroke_mm": 7.76, "rpm": 960, "vibration_angle_deg": 28.35, "inclination_deg": 0, "layer_depth_mm": 22.2, "probability": 0.952},
            {"rank": 2, "stroke_mm": 3.4, "rpm": 1450, "vibration_angle_deg": 28.4, "inclination_deg": 0, "layer_depth_mm": 33, "probability": 0.951}]
    })");
}

Json page_of(Json const& design) {
    return proposed_machines(design.dump());
}

TEST(DesignFile, GivesThePageTheSettingsOfTheMachine) {
    Json const page = page_of(design());
    EXPECT_EQ(page.at("wanted_t_per_h"), 5);
    EXPECT_EQ(page.at("confidence"), 0.95);
    EXPECT_EQ(page.at("untested"), false);
    Json const& settings = page.at("machines").at(0).at("settings");
    EXPECT_EQ(settings.at("stroke_mm"), 7.76);
    EXPECT_EQ(settings.at("depth_mm"), 22.2);
    EXPECT_EQ(settings.at("width_mm"), 400);
    EXPECT_EQ(settings.at("grain_mm"), 3.5);
    // The page's band is half of the central 95 %; a design's ends are those of the central 99.7 %: 0.09
    // * 1.96 / 3. Tolerance: rounding to six digits.
    EXPECT_NEAR(settings.at("friction_band").get<double>(), 0.0588, 1e-6);
    // A rolling friction that the design does not know is shown as the middle of what it can be, and said to
    // be assumed.
    EXPECT_EQ(settings.at("rolling_friction"), 0.1);
    EXPECT_EQ(page.at("assumed"), Json::array({"rolling_friction"}));
}

TEST(DesignFile, TellsWhichModelsDecideAndGivesTheSecondBestSpeed) {
    Json const page = page_of(design());
    Json const& models = page.at("machines").at(0).at("models");
    ASSERT_EQ(models.size(), 2u);
    EXPECT_EQ(models.at(0).at("is_beside"), false);
    EXPECT_EQ(models.at(1).at("is_beside"), true);
    EXPECT_EQ(models.at(0).at("flow_low"), 4.91);
    EXPECT_TRUE(models.at(1).at("probability").is_null());
    ASSERT_EQ(page.at("machines").size(), 2u);
    EXPECT_EQ(page.at("machines").at(1).at("settings").at("rpm"), 1450);
    EXPECT_TRUE(page.at("machines").at(1).at("models").empty());
}

TEST(DesignFile, RefusesOtherFiles) {
    for (char const* const key :
         {"task", "stroke_mm", "models", "speeds_compared", "mass_flow_wanted_t_per_h"}) {
        Json without = design();
        without.erase(key);
        EXPECT_THROW(page_of(without), core::note::Fault) << key;
    }
    Json wrong = design();
    wrong["stroke_mm"] = "7.76";
    EXPECT_THROW(page_of(wrong), core::note::Fault);
    EXPECT_THROW(proposed_machines("[]"), core::note::Fault);
    EXPECT_THROW(proposed_machines("{"), core::note::Fault);
}

}  // namespace
}  // namespace vibrotrough::learn
