#include "view/point_mass.hpp"

#include "theory/quantities.hpp"
#include "view/trough_motion.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

namespace vibrotrough::view {
namespace {

constexpr double length_x = 0.00536656, length_z = 0.00268328;
constexpr double two_pi = 2.0 * std::numbers::pi;

/// The trough of the demo: at Gamma = 2 the mass flies and slides (FN'), at Gamma = 0.6 it slides and rests.
class PointMass : public testing::Test {
  protected:
    static TheoryMotion motion_at(double throw_number) {
        theory::Conveyor conveyor{};
        conveyor.point = {.throw_number = throw_number, .tan_vibration_angle = 0.5, .friction = 0.23};
        return {theory::solve(conveyor), length_x, length_z};
    }

    FrameSource source{.folder = {},
                       .trough = {},
                       .time_step = 1e-5,
                       .angular_frequency = 85.5,
                       .drive = {.along = {{1, length_x, 0}}, .normal = {{1, length_z, 0}}},
                       .width = 0.018,
                       .caption = {}};
};

// Over n cycles the mass is conveyed by eta omega r cos(beta) n T = 2 pi n eta r cos(beta).
TEST_F(PointMass, IsConveyedByTheVelocityEfficiency) {
    for (double const throw_number : {0.6, 2.0, 3.0}) {
        auto const motion = motion_at(throw_number);
        ASSERT_TRUE(motion.motion.motion.converged);
        PointMassMotion const mass(source, motion);
        double const period = two_pi / source.angular_frequency;
        int const cycles = 12 * motion.motion.motion.period_cycles;
        // The trough is back at its initial position; eta is known to 1e-9, of 12 r cos(beta).
        EXPECT_NEAR(mass.at(cycles * period).x - mass.at(0.0).x,
                    two_pi * cycles * motion.motion.motion.velocity_efficiency * length_x, 1e-9)
            << throw_number;
    }
}

TEST_F(PointMass, RestsSlidesAndFliesInStep) {
    int flies = 0, rests = 0, slides = 0;
    for (double const throw_number : {0.15, 2.0}) {
        auto const motion = motion_at(throw_number);
        PointMassMotion const mass(source, motion);
        for (int i = 0; i < 720; ++i) {
            double const time = i / 360.0 * two_pi / source.angular_frequency;
            double const rate = source.angular_frequency * std::cos(source.angular_frequency * time);
            PointMassState const state = mass.at(time);
            // The relative velocity is the velocity minus that of the trough, A omega cos(omega t): sums of
            // numbers below 1 m/s.
            EXPECT_NEAR(state.velocity[0] - length_x * rate, state.relative_velocity[0], 1e-14);
            EXPECT_NEAR(state.velocity[2] - length_z * rate, state.relative_velocity[2], 1e-14);
            switch (state.phase) {
                case theory::PhaseKind::flight:
                    ++flies;
                    EXPECT_GE(state.gap, 0.0);
                    break;
                case theory::PhaseKind::rest:
                    ++rests;
                    EXPECT_EQ(state.relative_velocity[0], 0.0);
                    [[fallthrough]];
                default:
                    slides += state.phase == theory::PhaseKind::rest ? 0 : 1;
                    EXPECT_EQ(state.gap, 0.0);
                    EXPECT_EQ(state.relative_velocity[2], 0.0);
            }
        }
    }
    EXPECT_GT(flies, 0);
    EXPECT_GT(rests, 0);
    EXPECT_GT(slides, 0);
}

// The velocity is the derivative of the position: a central difference with an error of h^2 times the jerk,
// 3e-6 m/s.
TEST_F(PointMass, PositionsBelongToVelocities) {
    auto const motion = motion_at(2.0);
    PointMassMotion const mass(source, motion);
    double const h = 1e-6;
    int compared = 0;
    for (int i = 0; i < 97; ++i) {
        double const time = 0.3 + i * 0.00111;
        PointMassState const before = mass.at(time - h), after = mass.at(time + h);
        if (before.phase != after.phase) continue;
        ++compared;
        EXPECT_NEAR((after.x - before.x) / (2 * h), mass.at(time).velocity[0], 1e-5) << time;
        EXPECT_NEAR((after.gap - before.gap) / (2 * h), mass.at(time).relative_velocity[2], 1e-5) << time;
    }
    EXPECT_GT(compared, 80);
}

// With an elliptical drive and a harmonic, velocity minus relative velocity is still the velocity of the
// trough.
TEST_F(PointMass, FollowsAnyDrive) {
    theory::Conveyor conveyor{};
    conveyor.point = {.throw_number = 2.0, .tan_vibration_angle = 0.5, .friction = 0.23};
    conveyor.along_phase = 0.4;
    conveyor.along = conveyor.normal = {{3, 0.2, 0.7}};
    TheoryMotion const motion{theory::solve(conveyor), length_x, length_z};
    ASSERT_TRUE(motion.motion.motion.converged);
    source.drive = {.along = {{1, length_x, 0.4}, {3, 0.2 / 9 * length_x, 0.7}},
                    .normal = {{1, length_z, 0}, {3, 0.2 / 9 * length_z, 0.7}}};
    PointMassMotion const mass(source, motion);
    for (int i = 0; i < 100; ++i) {
        double const time = 0.0007 * i;
        PointMassState const state = mass.at(time);
        TroughState const trough = trough_state(source, time);
        EXPECT_NEAR(state.velocity[0] - state.relative_velocity[0], trough.vx, 1e-12);
        EXPECT_NEAR(state.velocity[2] - state.relative_velocity[2], trough.vz, 1e-12);
        EXPECT_GE(state.gap, 0.0);
        // The velocity of the trough is the derivative of its displacement: error h^2 omega^3 A / 6 = 1e-9
        // m/s plus rounding.
        double const h = 1e-6;
        EXPECT_NEAR((trough_state(source, time + h).x - trough_state(source, time - h).x) / (2 * h),
                    trough.vx, 1e-7);
    }
    EXPECT_EQ(trough_state(source, 0).x, 0.0);
}

TEST_F(PointMass, BlockStandsOnTheTroughBesideTheLayer) {
    PointMassBlock const block({0.0, 0.036, 0.0, 0.018, 0.0, 0.0});
    double const edge = 0.2 * std::sqrt(0.036 * 0.018);
    for (double const x : {0.0, 0.017, 0.019, 0.4, -0.4}) {
        auto const data = block.at({.phase = theory::PhaseKind::positive_slide,
                                    .x = x,
                                    .gap = 0.0005,
                                    .velocity = {0.2, 0, 0},
                                    .relative_velocity = {0.1, 0, 0}},
                                   0.002, 0.15);
        double bounds[6];
        data->GetBounds(bounds);
        // Single precision of 4 cm: 2e-9 m for each coordinate.
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(bounds[2 * axis + 1] - bounds[2 * axis], edge, 1e-8);
        EXPECT_NEAR(bounds[4], 0.0025, 1e-8);
        EXPECT_LT(bounds[3], 0.0) << "in front of the layer";
        double const centre = (bounds[0] + bounds[1]) / 2;
        EXPECT_GE(centre, 0.0);
        EXPECT_LE(centre, 0.036);
        EXPECT_NEAR(std::remainder(centre - 0.018 - x, 0.036), 0.0, 1e-8) << "wrapped like the grains";
        EXPECT_NEAR(data->GetPointData()->GetArray("velocity_relative_to_trough")->GetComponent(0, 0), 0.1,
                    1e-8);
        EXPECT_NEAR(data->GetPointData()->GetArray("velocity_from_mean")->GetComponent(0, 0), 0.05, 1e-8);
        auto* const motion = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("motion"));
        ASSERT_NE(motion, nullptr);
        EXPECT_EQ(motion->GetValue(0), "slides forwards");
    }
}

}  // namespace
}  // namespace vibrotrough::view
