#include "measure/reaction.hpp"

#include "point_mass_phases.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

using std::numbers::pi;
constexpr double frequency = 13, omega = 2 * pi * frequency;

/// The curves of a body on a trough with the velocities Re(V e^(i phase)), whose force on the trough is
/// -(c + i omega m) V plus its weight. The mean of e^(i phase) over an interval from a to b is
/// (e^(i b) - e^(i a)) / (i (b - a)).
PhaseCurves curves_of(std::complex<double> impedance, std::complex<double> along, std::complex<double> normal,
                      int cycles = 1) {
    using namespace std::complex_literals;
    PhaseCurves c;
    double const step = 2 * pi / PhaseSeries::per_cycle;
    for (int j = 0; j < cycles * PhaseSeries::per_cycle; ++j) {
        double const phase = (j + 1) * step;
        std::complex<double> const now = std::polar(1.0, phase),
                                   mean = (now - std::polar(1.0, phase - step)) / (1.0i * step);
        c.phase.push_back(phase);
        c.trough_velocity_x.push_back((along * now).real());
        c.trough_velocity_z.push_back((normal * now).real());
        c.tangential_force.push_back((-impedance * along * mean).real());
        c.normal_force.push_back(9.81 - (-impedance * normal * mean).real());
    }
    return c;
}

// Z = c + i omega m: a mass that is fixed to the trough and a damper to the ground, on a straight and on an
// elliptical path. Tolerance: rounding of sums of 100 terms.
TEST(Reaction, MassAndDamperAreFound) {
    double const mass = 0.7, damping = 3.5;
    std::complex<double> const impedance(damping, omega * mass);
    for (double const phase : {0.0, 0.6}) {
        std::complex<double> const along = std::polar(0.4, phase), normal = 0.2;
        auto const found = layer_reaction(curves_of(impedance, along, normal, 2), frequency);
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->added_mass, mass, 1e-12);
        EXPECT_NEAR(found->damping, damping, 1e-11);
        // P = c |V|^2 / 2. Tolerance: the mean velocity of an interval, cos(pi / 100) = 1 - 5e-4.
        double const power = damping * (0.4 * 0.4 + 0.2 * 0.2) / 2;
        EXPECT_NEAR(found->power, power, 1e-3 * power);
    }
}

// A point mass that never slides nor flies is a part of the trough: m_a = m, c = 0. One that slides or is
// thrown takes from the trough what it dissipates: power = c |V|^2 / 2 = f times the dissipation of a cycle
// (level trough). Tolerance: impacts and slides begin anywhere within an interval, which moves the phase of
// their force by up to half of one, 3 %.
TEST(Reaction, OfThePointMassIsThatOfTheTheory) {
    PointMassPhases resting({0.3, 0.3, 0, 5});
    auto const fixed =
        layer_reaction(layer_motion(resting.series(6), resting.facts).curves, resting.facts.frequency);
    ASSERT_TRUE(fixed);
    EXPECT_NEAR(fixed->added_mass, PointMassPhases::mass, 1e-4 * PointMassPhases::mass);
    EXPECT_NEAR(fixed->damping / (resting.omega * PointMassPhases::mass), 0, 1e-4);
    for (double const gamma : {0.8, 1.5, 2.0, 2.5}) {
        PointMassPhases moving({gamma, 0.5, 0, 0.3});
        LayerMotion const motion = layer_motion(moving.series(8), moving.facts);
        auto const found = layer_reaction(motion.curves, moving.facts.frequency);
        ASSERT_TRUE(found);
        double const work = theory::energy_balance(moving.theory).trough_work, speed = moving.omega * 0.006;
        double const power = PointMassPhases::mass * work * speed * speed * moving.facts.frequency;
        EXPECT_NEAR(found->power, power, 0.03 * power) << gamma;
        EXPECT_NEAR(found->damping * speed * speed / 2, found->power, 1e-3 * power) << gamma;
        EXPECT_NEAR(found->power, motion.dissipation.value() * moving.facts.frequency, 0.03 * power) << gamma;
        EXPECT_LT(found->added_mass, PointMassPhases::mass) << gamma;
    }
}

TEST(Reaction, NeedsCurvesAndAMovingTrough) {
    EXPECT_FALSE(layer_reaction({}, frequency));
    EXPECT_FALSE(layer_reaction(curves_of(1.0, 0.0, 0.0), frequency));
}

}  // namespace
}  // namespace vibrotrough::measure
