#include "learn/surface_model.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "learn/machine_keys.hpp"
#include "scenario/example_campaign.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

/// A campaign over throw number and friction whose layer is faster than the theory by 0.1 (2 - Gamma)^2 + 0.2
/// (mu - 0.4), known exactly on a grid.
class SurfaceModelTest : public testing::Test {
  protected:
    SurfaceModelTest() {
        std::ofstream(file_) << with("friction = 0.23", "friction = 0.3")
                             << "\n[sweep]\n\"trough.throw_number\" = [1, 2]\n"
                             << "\"trough.friction\" = [0.2, 0.6]\n";
        maker.emplace(file_);
        CampaignTrend const theory(*maker, inputs, {});
        std::vector<atlas::SurfacePoint> points;
        for (double gamma = 1; gamma < 2.01; gamma += 0.2) {
            for (double mu = 0.2; mu < 0.61; mu += 0.1) {
                atlas::Place const place{gamma, mu};
                double const eta = *theory.efficiency_at(place);
                points.push_back({"case", place, eta, eta + difference(gamma, mu), 0.002});
            }
        }
        surface = std::make_shared<atlas::Surface const>(inputs, points);
    }

    static double difference(double gamma, double mu) {
        return 0.1 * std::pow(2 - gamma, 2) + 0.2 * (mu - 0.4);
    }

    /// A measurement on the campaign's machine (r = 6 mm, 30 degrees, level) at a throw number.
    static MeasuredSpeed setting(double gamma) {
        double const frequency = std::sqrt(gamma * 9.81 / (0.006 * 0.5)) / (2 * std::numbers::pi);
        return {2, 0.006, frequency, 30 * degree, {}, 0, 0.002};
    }

    std::vector<atlas::SurfaceInput> const inputs{{"trough.throw_number", 1, 2},
                                                  {"trough.friction", 0.2, 0.6}};
    std::optional<scenario::CaseMaker> maker;
    std::shared_ptr<atlas::Surface const> surface;

  private:
    core::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "campaign.toml";
};

// v = eta omega r cos(beta), with eta of the layer.
TEST_F(SurfaceModelTest, SpeedOfTheLayer) {
    MeasuredSpeed const m = setting(1.5);
    auto const answer = surface_model(surface, *maker, {"trough.friction"}, {m}, 0)(std::array{0.35}, m);
    ASSERT_TRUE(answer);
    double const eta = *CampaignTrend(*maker, inputs, {}).efficiency_at({1.5, 0.35}) + difference(1.5, 0.35);
    double const trough_speed = 2 * std::numbers::pi * m.frequency * 0.006 * std::cos(30 * degree);
    EXPECT_DOUBLE_EQ(answer->trough_speed, trough_speed);
    EXPECT_NEAR(answer->speed / trough_speed, eta, 0.005);  // the points are known to 0.002
    EXPECT_LT(answer->sd / trough_speed, 0.01);
    EXPECT_GT(answer->sd, 0);
}

// Speeds of the layer at mu = 0.35 give this friction back; the theory alone does not explain them.
TEST_F(SurfaceModelTest, CalibrationFindsTheFriction) {
    std::vector<MeasuredSpeed> speeds{setting(1.1), setting(1.5), setting(1.9)};
    CalibrationModel const model = surface_model(surface, *maker, {"trough.friction"}, speeds, 0);
    for (MeasuredSpeed& m : speeds) {
        double const gamma = std::pow(2 * std::numbers::pi * m.frequency, 2) * 0.003 / 9.81;
        double const eta =
            *CampaignTrend(*maker, inputs, {}).efficiency_at({gamma, 0.35}) + difference(gamma, 0.35);
        m.speed = eta * model(std::array{0.35}, m)->trough_speed;
    }
    Calibration const c = calibrate(model, surface_parameters(inputs), speeds);
    EXPECT_TRUE(c.converged);
    Estimate const& e = c.parameters.front();
    EXPECT_EQ(e.parameter.name, "trough.friction");
    EXPECT_LE(e.low, 0.35);
    EXPECT_GE(e.high, 0.35);
    EXPECT_TRUE(e.identifiable);
    EXPECT_GT(c.best.p_value, 0.01);
}

TEST_F(SurfaceModelTest, OnlyOtherInputsThanTheMachineAreFree) {
    auto const parameters = surface_parameters(inputs);
    ASSERT_EQ(parameters.size(), 1U);
    EXPECT_EQ(parameters[0].name, "trough.friction");
    EXPECT_EQ(parameters[0].prior.high, 0.6);
}

TEST_F(SurfaceModelTest, WhatDoesNotFitIsRefused) {
    auto const refused = [&](std::vector<std::string> const& free, MeasuredSpeed const& m,
                             char const* words) {
        try {
            surface_model(surface, *maker, free, {m}, 0);
            ADD_FAILURE() << words;
        } catch (core::InputError const& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(words));
        }
    };
    std::vector<std::string> const friction{"trough.friction"};
    refused({}, setting(1.5), "add it to --free");
    refused({"trough.friction", "trough.throw_number"}, setting(1.5), "the measurements give it");
    refused({"trough.friction", "grains.friction"}, setting(1.5), "does not vary it");
    refused(friction, setting(2.6), "outside the range");
    MeasuredSpeed other = setting(1.5);
    other.inclination = 3 * degree;
    refused(friction, other, "inclination is 3 degrees");
    other = setting(1.5);
    other.amplitude = 0.003;
    other.frequency *= std::sqrt(2.0);
    refused(friction, other, "amplitude is 3 mm");
    other = setting(1.5);
    other.vibration_angle.reset();
    refused(friction, other, "no vibration angle");
}

}  // namespace
}  // namespace vibrotrough::learn
