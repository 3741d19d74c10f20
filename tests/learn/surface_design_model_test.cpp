#include "learn/surface_design_model.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "learn/risk_design.hpp"
#include "scenario/example_campaign.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

/// A campaign over throw number and friction (r = 6 mm, 30 degrees, level) whose layer is faster than
/// the theory by 0.1.
class SurfaceDesign : public testing::Test {
  protected:
    SurfaceDesign() {
        std::ofstream(file_) << with("friction = 0.23", "friction = 0.3")
                             << "\n[sweep]\n\"trough.throw_number\" = [1, 3]\n"
                             << "\"trough.friction\" = [0.2, 0.6]\n";
        maker.emplace(file_);
        CampaignTrend const theory(*maker, inputs, {});
        std::vector<atlas::SurfacePoint> points;
        for (double gamma = 1; gamma < 3.01; gamma += 0.25) {
            for (double mu = 0.2; mu < 0.61; mu += 0.1) {
                atlas::Place const place{gamma, mu};
                double const eta = *theory.efficiency_at(place);
                points.push_back({"case", place, eta, eta + 0.1, 0.004});
            }
        }
        surface = std::make_shared<atlas::Surface const>(inputs, points);
    }

    DesignModel model(KnownFriction const& friction = normal_friction(0.35, 0.02),
                      double numerics = 0) const {
        return surface_design_model(surface, CampaignTrend(*maker, inputs, {}), {}, {friction}, numerics);
    }

    std::vector<atlas::SurfaceInput> const inputs{{"trough.throw_number", 1, 3},
                                                  {"trough.friction", 0.2, 0.6}};
    std::optional<scenario::CaseMaker> maker;
    std::shared_ptr<atlas::Surface const> surface;

  private:
    core::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "campaign.toml";
};

// At a drive of the campaign's machine the model is the surface there.
TEST_F(SurfaceDesign, IsTheSurfaceAtTheDrive) {
    double const beta = std::numbers::pi / 6, gamma = 1.8;
    double const frequency = std::sqrt(gamma * 9.81 / (0.006 * std::sin(beta))) / (2 * std::numbers::pi);
    theory::Drive const drive{frequency, 0.006, beta, 0};
    auto const found = model().at({drive, 0.012}, 0.4);
    ASSERT_TRUE(found);
    double const theory = *CampaignTrend(*maker, inputs, {}).efficiency_at({gamma, 0.4});
    EXPECT_NEAR(found->efficiency, surface->at({gamma, 0.4}, theory).efficiency, 1e-9);
    EXPECT_NEAR(found->efficiency, theory + 0.1, 0.01);
    EXPECT_GT(found->sd(), 0);
    EXPECT_EQ(found->numerics_sd, 0);
    EXPECT_LE(model().excess(drive), 0);
    EXPECT_GT(model().excess({2 * frequency, 0.006, beta, 0}), 0);
}

// The numerical errors of the simulations are part of what the model is unsure of: sd^2 = statistics^2 +
// (numerics / 1.96)^2, and so the speed that is reached with 95 % is lower.
TEST_F(SurfaceDesign, IsAsUnsureAsItsSimulations) {
    double const frequency = std::sqrt(1.8 * 9.81 / (0.006 * 0.5)) / (2 * std::numbers::pi);
    theory::Drive const drive{frequency, 0.006, std::numbers::pi / 6, 0};
    KnownFriction const friction = normal_friction(0.35, 0.02);
    auto const alone = model(friction).at({drive, 0.012}, 0.4),
               found = model(friction, 0.0588).at({drive, 0.012}, 0.4);
    ASSERT_TRUE(alone && found);
    EXPECT_EQ(found->efficiency, alone->efficiency);
    EXPECT_EQ(found->statistics_sd, alone->statistics_sd);
    EXPECT_NEAR(found->numerics_sd, 0.03, 1e-5);
    EXPECT_NEAR(found->sd(), std::hypot(alone->sd(), 0.03), 1e-5);
}

// The design stays on the machine that was simulated, and within its range.
TEST_F(SurfaceDesign, StaysOnTheSimulatedMachine) {
    DesignTask task{};
    task.space.max_machine_number = 20;
    task.models = {model()};
    task.friction = normal_friction(0.35, 0.02);
    task.bulk_density = 600;
    task.width = 0.3;
    task.mass_flow = 2 / 3.6;
    RiskDesign const d = design_with_risk(task);
    EXPECT_TRUE(d.feasible);
    EXPECT_DOUBLE_EQ(d.drive.amplitude, 0.006);
    EXPECT_NEAR(d.drive.vibration_angle, std::numbers::pi / 6, 1e-12);
    EXPECT_EQ(d.drive.inclination, 0);
    EXPECT_LE(d.throw_number, 3);
    EXPECT_DOUBLE_EQ(d.depth, 0.012);
    task.space.amplitude = {0.001, 0.004};
    EXPECT_THROW(design_with_risk(task), std::invalid_argument);
    task.space.amplitude = {0.001, 0.01};
    task.depth = {0.02, 0.06};  // the campaign has 12 mm
    EXPECT_THROW(design_with_risk(task), std::invalid_argument);
}

// What was not simulated gives no answer, or none with a probability: each input of the layer.
TEST_F(SurfaceDesign, WhatWasNotSimulatedIsRefused) {
    auto const refused = [&](std::map<std::string, double> const& given, KnownMaterial const& material,
                             char const* words) {
        try {
            surface_design_model(surface, CampaignTrend(*maker, inputs, {}), given, material, 0);
            ADD_FAILURE() << words;
        } catch (core::InputError const& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(words));
        }
    };
    KnownFriction const usual = normal_friction(0.35, 0.02);
    refused({{"trough.throw_number", 2}}, {usual}, "the design chooses it");
    refused({{"grains.friction", 0.5}}, {usual}, "does not vary it");
    refused({}, {normal_friction(0.9, 0.02)}, "trough.friction = 0.2 to 0.6 and the material has 0.9");
    refused({}, {usual, {.diameter = 0.01}}, "grains.diameter = 3 mm and the material has 10 mm");
    refused({}, {usual, {.rolling_friction = Uncertain{0.1}}}, "grains.rolling_friction = 0 and");
    refused({}, {usual, {.friction = Uncertain{0.5, 0.1}}},
            "grains.friction = 0.5 and the material has 0.304");
    refused({}, {usual, {.friction = Uncertain{0.3}}}, "grains.friction = 0.5 and the material has 0.3");
    EXPECT_NO_THROW(surface_design_model(surface, CampaignTrend(*maker, inputs, {}), {},
                                         {usual, {0.003, Uncertain{0}, Uncertain{0.5}}}, 0));
    theory::Drive const drive{13.6, 0.006, std::numbers::pi / 6, 0};
    EXPECT_FALSE(model().untested(drive, 0.2, 4.0));
    EXPECT_THAT(model().untested(drive, 0.15, 4.0).value(), testing::HasSubstr("0.2 to 0.6, and not 0.15"));
}

}  // namespace
}  // namespace vibrotrough::learn
