#include "learn/atlas_design_model.hpp"

#include "atlas/atlas.hpp"
#include "core/error.hpp"
#include "learn/risk_design.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

constexpr double grain_diameter = 0.003;

/// A drive in the middle of the atlas: throw number 2, tan(beta) 0.65, amplitude of two diameters.
theory::Drive middle() {
    theory::Drive d{};
    d.amplitude = 2 * grain_diameter;
    d.vibration_angle = std::atan(0.65);
    d.inclination = 0;
    d.frequency = std::sqrt(2 * 9.81 / (d.amplitude * std::sin(d.vibration_angle))) / (2 * std::acos(-1.0));
    return d;
}

// The model is the atlas with what is not known in the middle of its ranges: depth 11.5, friction of grains
// 0.55, restitution 0.55. Tolerance: rounding of the throw number.
TEST(AtlasDesignModel, IsTheAtlas) {
    DesignModel const model = atlas_design_model({grain_diameter, Uncertain{0.05}});
    auto const value = model.at(middle(), 0.3).value();
    auto const known = atlas::value_at({2, 0.65, 0, 0.3, 2, 11.5, 0.55, 0.05, 0.55}).value();
    EXPECT_NEAR(value.efficiency, known.efficiency, 1e-6);
    EXPECT_GT(value.sd(), known.half_width / 1.96);
}

// A layer of a known depth is that of the atlas, and its depth no longer adds to the uncertainty; one that is
// deeper than those of the atlas counts as the deepest. Tolerance as above.
TEST(AtlasDesignModel, OfALayerKnowsItsDepth) {
    DesignModel const model = atlas_design_model({grain_diameter, Uncertain{0.05}});
    auto const at_depth = [](double depth) {
        return atlas::efficiency_at({2, 0.65, 0, 0.3, 2, depth, 0.55, 0.05, 0.55}).value();
    };
    for (double const depth : {4.0, 12.0}) {
        DesignModel const layer = model.of_layer(depth * grain_diameter);
        EXPECT_NEAR(layer.at(middle(), 0.3)->efficiency, at_depth(depth), 1e-6);
        EXPECT_EQ(layer.sources(middle()).size() + 1, model.sources(middle()).size());
        EXPECT_NEAR(layer.of_layer(7 * grain_diameter).at(middle(), 0.3)->efficiency, at_depth(7), 1e-6);
    }
    EXPECT_NEAR(model.of_layer(24 * grain_diameter).at(middle(), 0.3)->efficiency, at_depth(20), 1e-6);
}

// How far a drive is within the atlas does not depend on the layer; a depth at the end of the atlas lies
// within it, though 20 x 3.7 mm / 3.7 mm is rounded up, and 3 x 2.7 mm / 2.7 mm down.
TEST(AtlasDesignModel, TheEndsOfItsDepthsBelongToIt) {
    DesignModel const model = atlas_design_model({grain_diameter, Uncertain{0}});
    for (double const depth : {3.0, 20.0, 24.0}) {
        EXPECT_LT(model.of_layer(depth * grain_diameter).excess(middle()), -0.1);
        EXPECT_NEAR(model.of_layer(depth * grain_diameter).excess(middle()), model.excess(middle()), 1e-12);
    }
    EXPECT_FALSE(model.untested(middle(), 0.3, 20 * 0.0037 / 0.0037));
    EXPECT_FALSE(model.untested(middle(), 0.3, 3 * 0.0027 / 0.0027));
}

// Layers that are the faster the deeper they are, so that a thin one needs to be thick and a thick one thin:
// the search has no end, and the thick one carries the mass flow.
TEST(RiskDesign, OfTwoDepthsInTurnTheBetterOneIsTaken) {
    DesignTask task{};
    std::function<DesignModel(double)> const of_depth = [&](double depth) {
        DesignModel model = point_mass_design_model(0.01);
        model.at = [depth](theory::Drive const&, double) {
            return ModelEfficiency{depth > 0.012 ? 0.8 : 0.4, 0};
        };
        model.with_depth = of_depth;
        return model;
    };
    task.models = {of_depth(0)};
    task.friction = normal_friction(0.3, 0);
    task.bulk_density = 600;
    task.width = 0.2;
    task.depth = {0.002, 0.03};
    DesignTask thick = task;
    thick.models = {of_depth(0.02)};
    thick.models.front().with_depth = {};
    thick.mass_flow = 0.1;
    double const fast = design_with_risk(thick).sure_speed;
    task.mass_flow = 600 * 0.2 * 0.010 * fast;  // 10 mm of a thick layer's speed, 20 mm of a thin one's
    RiskDesign const design = design_with_risk(task);
    EXPECT_TRUE(design.feasible);
    EXPECT_GT(design.depth, 0.012);
    EXPECT_LT(design.depth, 0.022);
}

TEST(AtlasDesignModel, IsLessSureWithoutTheRollingFriction) {
    double const known = atlas_design_model({grain_diameter, Uncertain{0.1}}).at(middle(), 0.3)->sd(),
                 unknown = atlas_design_model({grain_diameter, {}}).at(middle(), 0.3)->sd();
    EXPECT_GT(unknown, known);
    EXPECT_THROW(atlas_design_model({grain_diameter, Uncertain{0.5}}), core::InputError);
}

TEST(AtlasDesignModel, KnowsWhereItEnds) {
    DesignModel const model = atlas_design_model({grain_diameter, {}});
    theory::DriveSpace const space = model.narrowed({});
    EXPECT_NEAR(space.amplitude.high, 4 * grain_diameter, 1e-12);
    EXPECT_NEAR(std::tan(space.vibration_angle.low), 0.3, 1e-12);
    EXPECT_LE(space.max_throw_number, 3.2);
    EXPECT_LE(model.excess(middle()), 0);
    theory::Drive fast = middle();
    fast.frequency *= 2;
    EXPECT_GT(model.excess(fast), 0);
    EXPECT_FALSE(model.untested(middle(), 0.3, 4.5));
    EXPECT_NE(model.untested(middle(), 0.3, 24.0)->find("depth in diameters of 3 to 20, and not 24"),
              std::string::npos);
    EXPECT_NE(model.untested(middle(), 0.05, 4.5)->find("friction"), std::string::npos);
    // Grains of 50 mm on a machine with a stroke of at most 30 mm: half of the smallest amplitude is not
    // reached.
    EXPECT_THROW(atlas_design_model({0.05, {}}).narrowed({}), core::InputError);
}

// A task within the atlas: 1.5 t/h of 3 mm grains on 200 mm, in a layer of 9 to 18 mm. What is said of the
// machine is said of a layer of its depth, within the 2 % to which both are made to agree: 0.01 of
// efficiency.
TEST(AtlasDesignModel, DesignsAMachine) {
    DesignTask task{};
    task.models = {atlas_design_model({grain_diameter, Uncertain{0.05}})};
    task.space.vibration_angle = {0.6, 0.6};
    task.friction = normal_friction(0.3, 0);
    task.bulk_density = 600;
    task.width = 0.2;
    task.mass_flow = 1500.0 / 3600;
    task.depth = {3 * grain_diameter, 6 * grain_diameter};
    task.grain_diameter = grain_diameter;
    RiskDesign const design = design_with_risk(task);
    EXPECT_TRUE(design.feasible);
    EXPECT_FALSE(design.untested);
    EXPECT_LE(task.models.front().excess(design.drive), 1e-6);
    // Mass flow = bulk density, depth, width and speed; the layer is not thinner than the task allows.
    EXPECT_GE(600 * design.depth * 0.2 * design.sure_speed, 0.999 * task.mass_flow);
    EXPECT_GE(design.depth, 3 * grain_diameter * (1 - 1e-9));
    DesignModel const layer = task.models.front().of_layer(design.depth);
    EXPECT_NEAR(design.forecasts.front().efficiency->efficiency, layer.at(design.drive, 0.3)->efficiency,
                0.01);
}

}  // namespace
}  // namespace vibrotrough::learn
