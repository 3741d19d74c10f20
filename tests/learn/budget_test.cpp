#include "learn/budget.hpp"

#include "learn/atlas_design_model.hpp"
#include "learn/design_report.hpp"
#include "learn/pellets.hpp"
#include "theory/point_mass.hpp"
#include "theory/random_number.hpp"
#include "theory/rolling_layer.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

// E x^2 = sd^2 and E x^4 = 3 sd^4 for a normal distribution, a^2/3 and a^4/5 for one from -a to a.
TEST(Uncertain, NodesGiveTheMoments) {
    auto const moment = [](Uncertain const& number, int power) {
        double sum = 0;
        for (UncertainNode const& node : nodes_of(number)) sum += node.share * std::pow(node.value, power);
        return sum;
    };
    Uncertain const normal{0, 0.7}, uniform = between_ends(-2, 2);
    EXPECT_NEAR(moment(normal, 0), 1, 1e-14);
    EXPECT_NEAR(moment(normal, 2), 0.49, 1e-14);
    EXPECT_NEAR(moment(normal, 4), 3 * std::pow(0.7, 4), 1e-13);
    EXPECT_NEAR(moment(uniform, 2), 4.0 / 3, 1e-14);
    EXPECT_NEAR(moment(uniform, 4), 16.0 / 5, 1e-13);
    EXPECT_NEAR(between_ends(0, 0.2).low(), 0, 1e-15);
    EXPECT_THROW(between_ends(0.2, 0), std::invalid_argument);
}

theory::Drive drive_of_960() {
    return {16, 0.004, 30 * std::numbers::pi / 180, 0};
}

/// 400 mm wide, with everything uncertain.
DesignTask uncertain_task(DesignModel const& model) {
    DesignTask task{};
    task.models = {model};
    task.friction = normal_friction(0.3, 0.03);
    task.errors = {0.0001, 0.01, 24};
    task.bulk_density = 600;
    task.width = 0.4;
    task.mass_flow = 1;
    return task;
}

std::map<std::string, double> deviations(ModelForecast const& forecast) {
    std::map<std::string, double> all;
    for (BudgetShare const& one : forecast.budget) all[one.source] = one.sd;
    return all;
}

/// The efficiency 0.5 + friction, which knows nothing of the drive, with sources of its own.
DesignModel linear_model() {
    auto const line = [](DesignLayer const&, double friction) {
        return ModelEfficiency{0.5 + friction, std::hypot(0.02, 0.04), 0.01, {{"rolling friction", 0.04}}};
    };
    return {.name = "a line", .discrepancy = 0.03, .speeds = std::make_shared<SpeedsByFunction>(line)};
}

// The flow is q = rho w h eta omega r cos(beta). Each share by itself: q/eta times the standard deviations of
// the efficiency, q/r and q/rho times those of amplitude and density, q tan(beta) that of the angle. The
// parts of the friction know its standard deviation to 0.2 %, and density and friction together add less than
// 0.2 %.
TEST(Budget, OfALinearModelAddsUpInSquares) {
    DesignTask const task = uncertain_task(linear_model());
    theory::Drive const drive = drive_of_960();
    RiskDesign const design = judge_machine(task, drive, 0.02);
    ModelForecast const& forecast = design.forecasts.front();
    double const q = 600 * 0.4 * 0.02 * 0.8 * drive.trough_speed();
    auto const sds = deviations(forecast);
    EXPECT_NEAR(sds.at("friction on the trough"), q / 0.8 * 0.03, 0.003 * q / 0.8 * 0.03);
    EXPECT_NEAR(sds.at("rolling friction"), q / 0.8 * 0.04, 1e-9);
    EXPECT_NEAR(sds.at("error of a line"), q / 0.8 * std::sqrt(0.03 * 0.03 + 0.02 * 0.02 + 0.01 * 0.01),
                1e-9);
    EXPECT_NEAR(sds.at("stroke"), q * 0.0001 / 0.004, 1e-9);
    EXPECT_NEAR(sds.at("bulk density"), q * 24 / 600, 0.003 * q * 24 / 600);
    EXPECT_NEAR(sds.at("vibration angle"), q * std::tan(drive.vibration_angle) * 0.01, 1e-3 * q * 0.01);
    double squares = 0, before = 1e9;
    for (BudgetShare const& one : forecast.budget) {
        squares += one.sd * one.sd;
        EXPECT_LE(one.sd, before);
        EXPECT_GT(one.gained, 0) << one.source;
        before = one.sd;
    }
    EXPECT_NEAR(std::sqrt(squares), forecast.flow_sd, 1e-9);
    auto const json = design_json(task, design).at("models").at(0);
    EXPECT_EQ(json.at("budget").at(0).at("source"), forecast.budget.front().source);
    EXPECT_THAT(design_text(task, design), testing::HasSubstr("What to measure first, by a line"));
}

// A model that ends just above the machine's stroke knows the speed on one side of it alone; the speed is
// proportional to the stroke, so that this side tells the same standard deviation q/r times that of the
// amplitude.
TEST(Budget, KnowsASettingBesideTheEndOfTheModel) {
    DesignModel model = linear_model();
    theory::Drive const drive = drive_of_960();
    auto const part = [&, whole = model](DesignLayer const& other, double friction) {
        return other.drive.amplitude > drive.amplitude * 1.001 ? std::nullopt : whole.at(other, friction);
    };
    model.speeds = std::make_shared<SpeedsByFunction>(part);
    auto const sds = deviations(judge_machine(uncertain_task(model), drive, 0.02).forecasts.front());
    double const q = 600 * 0.4 * 0.02 * 0.8 * drive.trough_speed();
    EXPECT_NEAR(sds.at("stroke"), q * 0.0001 / 0.004, 1e-9);
}

// 20,000 tries of friction, stroke, angle, density and the error of the point mass. They know a standard
// deviation to 0.5 % and a probability to 0.003; settings count as linear, which adds at most as much here.
TEST(Budget, IsThatOfAMonteCarlo) {
    DesignTask task = uncertain_task(point_mass_design_model(0.05));
    theory::Drive const drive = drive_of_960();
    task.mass_flow = 0.97 * judge_machine(task, drive, 0.02).forecasts.front().median_flow;
    ModelForecast const forecast = judge_machine(task, drive, 0.02).forecasts.front();
    std::mt19937_64 random(20261126);
    std::normal_distribution<double> normal;
    double sum = 0, squares = 0, reached = 0;
    constexpr int tries = 20000;
    for (int i = 0; i < tries; ++i) {
        double const mu = 0.3 + 0.03 * normal(random), rho = 600 + 24 * normal(random);
        theory::Drive one = drive;
        one.amplitude += 0.0001 * normal(random);
        one.vibration_angle += 0.01 * normal(random);
        double const eta =
            theory::solve(theory::PointMass{one.throw_number(), std::tan(one.vibration_angle), 0, mu})
                .velocity_efficiency +
            0.05 * normal(random);
        double const flow = rho * 0.4 * 0.02 * eta * one.trough_speed();
        sum += flow;
        squares += flow * flow;
        reached += flow >= task.mass_flow ? 1 : 0;
    }
    double const mean = sum / tries, sd = std::sqrt(squares / tries - mean * mean);
    EXPECT_NEAR(forecast.flow_sd, sd, 0.015 * sd);
    EXPECT_NEAR(forecast.probability, reached / tries, 0.012);
}

// What the rolling friction costs when nobody gives it: known exactly, that share is gone, the others stay,
// and as much more is sure as the budget says.
TEST(Budget, SaysWhatAnUnknownRollingFrictionCosts) {
    constexpr double grain = 0.0035;
    auto const forecast = [&](KnownGrains const& grains) {
        DesignTask task = uncertain_task(atlas_design_model(grains, 0, 0.3));
        task.friction = normal_friction(0.3, 0);
        task.grain_diameter = grain;
        return judge_machine(task, drive_of_960(), 4 * grain).forecasts.front();
    };
    ModelForecast const unknown = forecast({grain, {}}), known = forecast({grain, Uncertain{0.1}});
    auto const share = std::ranges::find_if(unknown.budget, [](BudgetShare const& one) {
        return one.source == "rolling friction (not given: 0 to 0.2)";
    });
    ASSERT_NE(share, unknown.budget.end());
    EXPECT_GT(share->sd, 0);
    EXPECT_EQ(deviations(known).count("rolling friction"), 0U);
    EXPECT_NEAR(known.flow_sd, std::sqrt(std::pow(unknown.flow_sd, 2) - std::pow(share->sd, 2)), 1e-9);
    EXPECT_NEAR(known.sure_flow - unknown.sure_flow, share->gained, 1e-9);
}

// The bulk density changes what a trough carries, and not its speed.
TEST(Budget, TheBulkDensityDoesNotChangeTheSpeed) {
    DesignTask task = pellets();
    theory::Drive const drive{15, 0.005, 0.5, 0};
    RiskDesign const exact = judge_machine(task, drive, 0.03);
    task.errors.bulk_density = 60;
    RiskDesign const d = judge_machine(task, drive, 0.03);
    EXPECT_NEAR(d.sure_speed, exact.sure_speed, 1e-9);
    EXPECT_NEAR(exact.sure_flow, 600 * 0.3 * 0.03 * exact.sure_speed, 1e-9);
    EXPECT_LT(d.sure_flow, 0.99 * exact.sure_flow);
}

// The rolling friction of the grains adds to the dry torque of the law, mu_i + mu_r.
TEST(Budget, TheLawKnowsTheRollingFrictionOfTheGrains) {
    theory::Drive const drive = drive_of_960();
    auto const law = [&](double rolling_friction) {
        theory::RollingLayer layer{
            {drive.throw_number(), std::tan(drive.vibration_angle), std::tan(drive.inclination), 0.3}, {}};
        layer.law.dry_torque += rolling_friction;
        return solve(layer).motion.velocity_efficiency;
    };
    EXPECT_EQ(rolling_layer_design_model().at({drive, 0.012}, 0.3)->efficiency, law(0));
    EXPECT_EQ(rolling_layer_design_model(Uncertain{0.1}).at({drive, 0.012}, 0.3)->efficiency, law(0.1));
    EXPECT_EQ(rolling_layer_design_model(Uncertain{0.1}).at({drive, 0.012}, 0.3)->sd(), 0);

    // No layer was simulated that rolls against more.
    EXPECT_FALSE(rolling_layer_design_model(Uncertain{0.1}).untested(drive, 0.3, 4.0));
    EXPECT_THAT(rolling_layer_design_model(Uncertain{0.4}).untested(drive, 0.3, 4.0).value(),
                testing::HasSubstr("a rolling friction of 0.4, above 0.2"));

    // Nobody gave it: anything between 0 and 0.2, as the standard deviation of 200 equal parts of that.
    // Tolerance: 3 %, because three nodes stand for the distribution.
    DesignModel const unknown = rolling_layer_design_model({});
    double sum = 0, squares = 0;
    constexpr int parts = 200;
    for (int i = 0; i < parts; ++i) {
        double const eta = law(0.2 * (i + 0.5) / parts);
        sum += eta / parts;
        squares += eta * eta / parts;
    }
    double const sd = std::sqrt(squares - sum * sum);
    ASSERT_GT(sd, 0.02);
    EXPECT_NEAR(unknown.at({drive, 0.012}, 0.3)->sd(), sd, 0.03 * sd);
    auto const sources = unknown.at({drive, 0.012}, 0.3)->sources;
    ASSERT_EQ(sources.size(), 1U);
    EXPECT_EQ(sources.front().name, "rolling friction (not given: 0 to 0.2)");
    EXPECT_EQ(sources.front().sd, unknown.at({drive, 0.012}, 0.3)->sd());
}

}  // namespace
}  // namespace vibrotrough::learn
