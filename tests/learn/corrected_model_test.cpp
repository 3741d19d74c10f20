#include "learn/corrected_model.hpp"

#include "learn/pellets.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

constexpr double grain = 0.003;

/// A drive of a throw number of 2 with tan(beta) 0.5 and an amplitude of two diameters.
theory::Drive machine(double throw_number = 2) {
    theory::Drive d{};
    d.amplitude = 2 * grain;
    d.vibration_angle = std::atan(0.5);
    d.inclination = 0;
    d.frequency =
        std::sqrt(throw_number * 9.81 / (d.amplitude * std::sin(d.vibration_angle))) / (2 * std::acos(-1.0));
    return d;
}

/// A layer that is faster than the model says by `more`.
SimulatedLayer layer(DesignModel const& model, double more, double half_width, double friction = 0.3) {
    return {machine(),  friction, 4 * grain, model.at({machine(), 4 * grain}, friction)->efficiency + more,
            half_width, 0.02};
}

// Where a layer was simulated, the model is what the layer is: posterior mean of a normal prior of variance
// s^2 (half of it common) and a value with variance n^2, s^2 / (s^2 + n^2) of the way, with the deviation s n
// / sqrt(s^2 + n^2). Exact but for rounding.
TEST(CorrectedModel, IsTheLayerWhereItWasSimulated) {
    DesignModel const model = point_mass_design_model();
    double const s = model.missed(machine(), {}), n = 0.03 / 1.959963984540054;
    DesignModel const corrected = corrected_design_model(model, {layer(model, 0.2, 0.03)}, grain);
    auto const before = model.at({machine(), 4 * grain}, 0.3).value(),
               after = corrected.at({machine(), 4 * grain}, 0.3).value();
    EXPECT_NEAR(after.efficiency - before.efficiency, 0.2 * s * s / (s * s + n * n), 1e-9);
    EXPECT_NEAR(after.statistics_sd, s * n / std::hypot(s, n), 1e-9);
    // The numerical errors of a simulation are those of the model that rests on it.
    EXPECT_NEAR(after.numerics_sd, 0.02 / 1.959963984540054, 1e-12);
    EXPECT_EQ(corrected.missed(machine(), {}), 0);
}

// Far away the common half of the variance is left: the mean goes half of the way, the variance is
// s^2 (1 - 1/2 * 1/2) (for n = 0).
TEST(CorrectedModel, IsTheModelFarAway) {
    DesignModel const model = point_mass_design_model(0.1);
    DesignModel const corrected = corrected_design_model(model, {layer(model, 0.2, 0)}, grain);
    theory::Drive const far = machine(3.2);
    auto const before = model.at({far, 4 * grain}, 2.5).value(),
               after = corrected.at({far, 4 * grain}, 2.5).value();
    EXPECT_NEAR(after.efficiency - before.efficiency, 0.1, 2e-3);
    EXPECT_NEAR(after.sd(), 0.1 * std::sqrt(0.75), 0.01);
}

// More layers of one place that agree: the noise falls as their number grows, and does not vanish.
TEST(CorrectedModel, LayersOfOnePlaceAreAveraged) {
    DesignModel const model = point_mass_design_model();
    std::vector<SimulatedLayer> const one{layer(model, 0.1, 0.04)}, four(4, one.front());
    double const
        sd_of_one = corrected_design_model(model, one, grain).at({machine(), 4 * grain}, 0.3)->statistics_sd,
        sd_of_four =
            corrected_design_model(model, four, grain).at({machine(), 4 * grain}, 0.3)->statistics_sd;
    EXPECT_LT(sd_of_four, 0.6 * sd_of_one);
    EXPECT_GT(sd_of_four, 0.4 * sd_of_one);
}

// What a layer tells of the error of a model that knows its depth is told at its own depth, and holds at
// others: the model is 0.1 slower for each diameter of depth, and the layer 0.05 faster than it. Tolerance:
// rounding.
TEST(CorrectedModel, IsToldTheErrorAtTheDepthOfTheLayer) {
    DesignModel model = point_mass_design_model(0.1);
    auto const by_depth = [shallow = model](DesignLayer const& one, double friction) {
        auto value = shallow.at(one, friction);
        value->efficiency -= 0.1 * (one.depth / grain - 4);
        return value;
    };
    model.speeds = std::make_shared<SpeedsByFunction>(by_depth);
    DesignModel const corrected = corrected_design_model(model, {layer(model, 0.05, 0)}, grain);
    for (double const depth : {4 * grain, 6 * grain}) {
        DesignLayer const asked{machine(), depth};
        EXPECT_NEAR(corrected.at(asked, 0.3)->efficiency, model.at(asked, 0.3)->efficiency + 0.05, 1e-6);
    }
}

// The law has not been tested in a layer 20 diameters deep; a layer that was simulated there tells its error.
TEST(CorrectedModel, ItsErrorIsKnownWhereLayersWereSimulated) {
    DesignModel const model = rolling_layer_design_model();
    DesignModel const corrected = corrected_design_model(model, {layer(model, 0.05, 0.03)}, grain);
    EXPECT_TRUE(model.untested(machine(), 0.3, 20.0));
    EXPECT_FALSE(corrected.untested(machine(), 0.3, 20.0));
    EXPECT_TRUE(corrected.untested(machine(3.2), 0.3, 20.0));
    EXPECT_THROW(corrected_design_model(model, {}, grain), std::invalid_argument);
}

// A machine that is there has the probability of its own layer: at the depth that the design chose, that of
// the design; with half of the layer, none.
TEST(JudgeMachine, IsTheDesignAtItsOwnDepth) {
    DesignTask const task = pellets();
    RiskDesign const design = design_with_risk(task);
    RiskDesign const same = judge_machine(task, design.drive, design.depth);
    EXPECT_EQ(same.probability, design.probability);
    EXPECT_EQ(same.feasible, design.feasible);
    RiskDesign const thin = judge_machine(task, design.drive, design.depth / 2);
    EXPECT_LT(thin.probability, 0.5);
    EXPECT_FALSE(thin.feasible);
    EXPECT_EQ(thin.depth, design.depth / 2);
}

}  // namespace
}  // namespace vibrotrough::learn
