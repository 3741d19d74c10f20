#include "learn/atlas_design_model.hpp"

#include "atlas/atlas.hpp"
#include "core/error.hpp"
#include "learn/risk_design.hpp"

#include <cmath>
#include <stdexcept>

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

DesignLayer layer(double depth) {
    return {middle(), depth * grain_diameter};
}

// The model is the atlas with what is not known in the middle of its ranges: friction of grains 0.55,
// restitution 0.6026. Tolerance: rounding of the throw number. What a search takes for it is near it.
TEST(AtlasDesignModel, IsTheAtlas) {
    DesignModel const model = atlas_design_model({grain_diameter, Uncertain{0.05}});
    for (double const depth : {4.0, 12.0}) {
        auto const value = model.at(layer(depth), 0.3).value(),
                   near = model.at(layer(depth), 0.3, Precision::near).value();
        auto const known = atlas::value_at({2, 0.65, 0, 0.3, 2, depth, 0.55, 0.05, 0.6026}).value();
        EXPECT_NEAR(value.efficiency, known.efficiency, 1e-6);
        EXPECT_GT(value.sd(), known.half_width / 1.96);
        EXPECT_NEAR(near.efficiency, value.efficiency,
                    0.02);  // a draw differs by less than the layers' noise
        EXPECT_NEAR(near.sd(), value.sd(), 0.3 * value.sd());
    }
}

// A depth at the end of the atlas lies within it, though 20 x 3.7 mm / 3.7 mm is rounded up, and 3 x 2.7 mm /
// 2.7 mm down.
TEST(AtlasDesignModel, TheEndsOfItsDepthsBelongToIt) {
    DesignModel const model = atlas_design_model({grain_diameter, Uncertain{0}});
    EXPECT_FALSE(model.untested(middle(), 0.3, 20 * 0.0037 / 0.0037));
    EXPECT_FALSE(model.untested(middle(), 0.3, 3 * 0.0027 / 0.0027));
}

TEST(AtlasDesignModel, IsLessSureWithoutTheRollingFriction) {
    double const known = atlas_design_model({grain_diameter, Uncertain{0.1}}).at(layer(5), 0.3)->sd(),
                 unknown = atlas_design_model({grain_diameter, {}}).at(layer(5), 0.3)->sd();
    EXPECT_GT(unknown, known);
    EXPECT_THROW(atlas_design_model({grain_diameter, Uncertain{0.5}}), core::InputError);
}

TEST(AtlasDesignModel, KnowsWhereItEnds) {
    DesignModel const model = atlas_design_model({grain_diameter, {}});
    theory::DriveSpace space;
    theory::Range depth{0, 1};
    model.speeds->narrow(space, depth);
    EXPECT_EQ(depth.low, 2 * grain_diameter);
    EXPECT_EQ(depth.high, 20 * grain_diameter);
    EXPECT_NEAR(space.amplitude.high, 4 * grain_diameter, 1e-12);
    EXPECT_NEAR(std::tan(space.vibration_angle.low), 0.3, 1e-12);
    EXPECT_LE(space.max_throw_number, 3.2);
    EXPECT_LE(model.excess(middle()), 0);
    theory::Drive fast = middle();
    fast.frequency *= 2;
    EXPECT_GT(model.excess(fast), 0);
    EXPECT_FALSE(model.untested(middle(), 0.3, 4.5));
    EXPECT_NE(model.untested(middle(), 0.3, 24.0)->find("diameters of a grain of 2 to 20, and not 24"),
              std::string::npos);
    EXPECT_NE(model.untested(middle(), 0.05, 4.5)->find("frictions of 0.15 to 0.6, and not 0.05"),
              std::string::npos);
    // Grains of 250 mm on a machine with a stroke of at most 30 mm: half of the smallest amplitude is not
    // reached.
    space = {};
    EXPECT_THROW(atlas_design_model({0.25, {}}).speeds->narrow(space, depth), std::invalid_argument);
}

// A task within the atlas: 1.5 t/h of 3 mm grains on 200 mm, in a layer of 9 to 18 mm. What is said of the
// machine is said of a layer of its depth.
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
    EXPECT_EQ(design.forecasts.front().efficiency->efficiency,
              task.models.front().at({design.drive, design.depth}, 0.3)->efficiency);
}

}  // namespace
}  // namespace vibrotrough::learn
