// The atlas as a model of measured speeds, and an error that all measurements share.

#include "learn/atlas_speed_model.hpp"

#include "atlas/atlas.hpp"
#include "core/error.hpp"
#include "learn/machine_keys.hpp"
#include "learn/point_mass_model.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

constexpr double diameter = 0.003;

/// Five settings of a machine, throw numbers 1.2 to 2.8 at an amplitude of a diameter, without speeds.
std::vector<MeasuredSpeed> five_settings(double uncertainty) {
    std::vector<MeasuredSpeed> speeds;
    for (double const gamma : {1.2, 1.6, 2.0, 2.4, 2.8}) {
        double const frequency = std::sqrt(gamma * 9.81 / (diameter * 0.5)) / (2 * std::numbers::pi);
        speeds.push_back(
            {static_cast<int>(speeds.size()) + 2, diameter, frequency, 30 * degree, 0.0, 0, uncertainty});
    }
    return speeds;
}

std::map<std::string, double> known_layer() {
    return {{"grain_friction", 0.5}, {"rolling_friction", 0.1}, {"restitution", 0.5}, {"depth", 4}};
}

CalibrationSettings short_chains() {
    CalibrationSettings settings;
    settings.sampler = {
        .chains = 4, .warm_up = 300, .draws = 700, .most_draws = 700, .points_per_start = 100};
    return settings;
}

// The speed is the atlas' efficiency at the place of the setting times omega r cos(beta); half of the
// statistical variance is common to all settings, so that both parts together are the half-width of the atlas
// over 1.96.
TEST(AtlasSpeedModel, IsTheAtlasInMetresPerSecond) {
    auto const speeds = five_settings(0.001);
    CalibrationModel const model = atlas_speed_model(diameter, {"friction"}, known_layer(), speeds);
    MeasuredSpeed const& one = speeds[2];
    ModelSpeed const said = *model(std::array{0.3}, one);
    auto const value = *atlas::value_at({2.0, std::tan(30 * degree), 0, 0.3, 1, 4, 0.5, 0.1, 0.5});
    double const trough = 2 * std::numbers::pi * one.frequency * diameter * std::cos(30 * degree);
    EXPECT_NEAR(said.trough_speed, trough, 1e-12);
    EXPECT_NEAR(said.speed, value.efficiency * trough, 1e-9);
    EXPECT_NEAR(std::hypot(said.sd, said.common_sd) * 1.959964, value.half_width * trough, 1e-9);
}

// Speeds made by the atlas itself with friction 0.3: the interval holds it, and the model's own error, which
// no measurement removes, keeps it wider than the precision of the speeds (0.1 mm/s) alone would.
TEST(AtlasSpeedModel, FindsTheFrictionThatMadeTheSpeeds) {
    auto speeds = five_settings(1e-4);
    CalibrationModel const model = atlas_speed_model(diameter, {"friction"}, known_layer(), speeds);
    for (MeasuredSpeed& one : speeds) one.speed = model(std::array{0.3}, one)->speed;
    Calibration const c = calibrate(model, {atlas_parameters().front()}, speeds, short_chains());
    EXPECT_LE(c.parameters.front().low, 0.3);
    EXPECT_GE(c.parameters.front().high, 0.3);
    EXPECT_GT(c.parameters.front().high - c.parameters.front().low, 0.02);
}

// What is not known of the layer is found with the friction, whose interval is the wider for it.
TEST(AtlasSpeedModel, AnUnknownLayerWidensTheInterval) {
    EXPECT_THAT(with_unknown_layer({"friction"}, {{"depth", 4}}),
                testing::ElementsAre("friction", "grain_friction", "rolling_friction", "restitution"));
    auto speeds = five_settings(1e-4);
    CalibrationModel const exact = atlas_speed_model(diameter, {"friction"}, known_layer(), speeds);
    for (MeasuredSpeed& one : speeds) one.speed = exact(std::array{0.3}, one)->speed;
    CalibrationSettings shorter = short_chains();
    shorter.sampler.warm_up = 100;
    shorter.sampler.draws = shorter.sampler.most_draws = 200;
    auto const width = [&](std::vector<std::string> const& free, std::map<std::string, double> const& fixed) {
        std::vector<FreeParameter> parameters;
        for (std::string const& name : free)
            parameters.push_back(*std::ranges::find(atlas_parameters(), name, &FreeParameter::name));
        auto const found =
            calibrate(atlas_speed_model(diameter, free, fixed, speeds), parameters, speeds, shorter);
        return found.parameters.front().high - found.parameters.front().low;
    };
    EXPECT_GT(width(with_unknown_layer({"friction"}, {}), {}), 1.2 * width({"friction"}, known_layer()));
}

TEST(AtlasSpeedModel, RefusesWhatTheAtlasDoesNotHave) {
    auto speeds = five_settings(0.001);
    EXPECT_THAT(
        [&] { atlas_speed_model(diameter, {"mass"}, known_layer(), speeds); },
        testing::ThrowsMessage<core::InputError>(testing::HasSubstr("not a quantity of a layer of spheres")));
    auto deep = known_layer();
    deep["depth"] = 24;
    EXPECT_THAT(
        [&] { atlas_speed_model(diameter, {"friction"}, deep, speeds); },
        testing::ThrowsMessage<core::InputError>(testing::HasSubstr("depth=24: the atlas has 2 to 20")));
    speeds[1].amplitude = 10 * diameter;
    EXPECT_THAT([&] { atlas_speed_model(diameter, {"friction"}, known_layer(), speeds); },
                testing::ThrowsMessage<core::InputError>(
                    testing::HasSubstr("line 3: outside of the atlas: throw_number")));
}

/// In how many of 100 data sets the 95 % interval holds the friction that made them, which is drawn from the
/// prior, when the model is off by 0.05 times a normal number that all five speeds share, and by
/// `independent` times one for each speed.
int coverage_with_common_errors(double assumed, double independent) {
    std::mt19937_64 random(20261126);
    std::normal_distribution<double> normal;
    int inside = 0;
    for (int i = 0; i < 100; ++i) {
        auto const [low, high] = point_mass_parameters().front().prior;
        double const friction = std::uniform_real_distribution<double>(low, high)(random);
        auto speeds = five_settings(0.001);
        CalibrationModel const model = point_mass_model({"friction"}, {}, speeds);
        double const shared = 0.05 * normal(random);
        for (MeasuredSpeed& one : speeds) {
            ModelSpeed const exact = *model(std::array{friction}, one);
            one.speed = exact.speed + (shared + independent * normal(random)) * exact.trough_speed +
                        one.uncertainty * normal(random);
        }
        CalibrationSettings settings = short_chains();
        settings.common_error = assumed;
        Estimate const e =
            calibrate(model, {point_mass_parameters().front()}, speeds, settings).parameters.front();
        inside += e.low <= friction && friction <= e.high ? 1 : 0;
    }
    return inside;
}

// The discrepancy that is estimated holds the independent errors. 90 to 99 of 100 is the central 97 % of the
// binomial distribution of a 95 % interval.
TEST(CalibrationCoverage, OfAModelThatIsWrongInOneDirection) {
    int const inside = coverage_with_common_errors(0.05, 0.05);
    RecordProperty("inside", inside);
    EXPECT_GE(inside, 90);
    EXPECT_LE(inside, 99);
}

// Negative control: taken for errors that are independent from setting to setting, they look like friction.
TEST(CalibrationCoverage, IsLostWhenCommonErrorsAreTakenForIndependentOnes) {
    EXPECT_LT(coverage_with_common_errors(0, 0), 80);
}

}  // namespace
}  // namespace vibrotrough::learn
