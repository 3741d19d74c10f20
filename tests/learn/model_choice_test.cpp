#include "learn/model_choice.hpp"

#include "learn/atlas_design_model.hpp"
#include "learn/design_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double pellet = 0.0035;

/// Pellets of 3.5 mm on a trough 400 mm wide, whose drive turns 960 times a minute, with at most 4 g.
DesignTask trough_of_pellets(double tonnes_per_hour) {
    DesignTask task{};
    task.space.frequency = {16, 16};
    task.space.max_machine_number = 4;
    task.space.vibration_angle = {0.49, 0.49};  // 28 degrees: a throw number of 1.88 with 4 g
    task.friction = normal_friction(0.3, 0);
    task.bulk_density = 600;
    task.width = 0.4;
    task.mass_flow = tonnes_per_hour / 3.6;
    task.grain_diameter = pellet;
    return task;
}

ModelsToChoose all_models() {
    return {atlas_design_model({pellet, Uncertain{0.1}}), "", rolling_layer_design_model(),
            point_mass_design_model()};
}

std::vector<std::string> names(std::vector<ModelForecast> const& forecasts) {
    std::vector<std::string> all;
    for (ModelForecast const& one : forecasts) all.push_back(one.model);
    return all;
}

// Its layers are as deep as those of the atlas, and what the others say is told beside it.
TEST(ModelChoice, TheAtlasDecidesWhereItKnowsTheLayer) {
    auto const [task, design] = design_by_known_model(trough_of_pellets(4), all_models());
    EXPECT_TRUE(design.feasible);
    EXPECT_THAT(names(design.forecasts), ElementsAre("the atlas"));
    EXPECT_THAT(names(design.beside), ElementsAre("the rolling-layer law", "the point mass"));
    EXPECT_GE(design.depth, 3 * pellet);
    EXPECT_LE(design.depth, 20 * pellet);
    EXPECT_THAT(design_text(task, design), HasSubstr("beside it, for comparison:\nthe rolling-layer law"));
    auto const json = design_json(task, design);
    EXPECT_EQ(json.at("models_beside").at(1).at("model"), "the point mass");
    // The maker's rule is 0.48 to 0.55 of the trough's speed, the layer has more than 0.7.
    EXPECT_THAT(json.at("rules_of_thumb").at(0).at("why_different").get<std::string>(),
                testing::AllOf(HasSubstr("less than the atlas says"), HasSubstr("at throw number 1.88")));
}

// The layer that carries 12 t/h is deep, and within the atlas.
TEST(ModelChoice, ADeepLayerIsTheAtlasToo) {
    auto const [task, design] = design_by_known_model(trough_of_pellets(12), all_models());
    EXPECT_TRUE(design.feasible);
    EXPECT_THAT(names(design.forecasts), ElementsAre("the atlas"));
    EXPECT_GT(design.depth, 12 * pellet);
    EXPECT_LE(design.depth, 20 * pellet);
    EXPECT_THAT(design.warnings, testing::IsEmpty());
}

// Where none does it, the deepest layers that are known say how wide a trough would.
TEST(ModelChoice, AnAnswerThatIsKnownIsBetterThanNone) {
    auto const [task, design] = design_by_known_model(trough_of_pellets(120), all_models());
    EXPECT_FALSE(design.feasible);
    EXPECT_FALSE(design.untested);
    EXPECT_NEAR(task.depth.high, 16 * pellet, 1e-12);
    EXPECT_GT(*design.width_needed, 2.5);
}

// A layer of one or two diameters is known by none of them: the point mass answers, without a probability.
TEST(ModelChoice, WithoutAKnownModelThePointMassAnswers) {
    DesignTask task = trough_of_pellets(0.5);
    task.depth = {pellet, 1.9 * pellet};
    ModelsToChoose models = all_models();
    models.atlas.reset();
    models.why_no_atlas = "it was not asked";
    auto const design = design_by_known_model(task, models).design;
    EXPECT_THAT(names(design.forecasts), ElementsAre("the point mass"));
    EXPECT_TRUE(design.untested);
    EXPECT_THAT(design.warnings, testing::Contains("The atlas does not decide: it was not asked."));
    EXPECT_THAT(design.warnings,
                testing::Contains(testing::StartsWith("The rolling-layer law does not decide: ")));
}

}  // namespace
}  // namespace vibrotrough::learn
