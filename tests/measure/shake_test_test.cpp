#include "measure/shake_test.hpp"

#include "point_mass_phases.hpp"
#include "theory/friction_test.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

/// K = Gamma / sin(beta), with a very small beta instead of zero.
PointMassPhases shaken(double machine_number, double friction) {
    constexpr double tan_beta = 1e-7;
    return PointMassPhases(theory::PointMass{machine_number * tan_beta, tan_beta, 0, friction});
}

// Eqs. 10 and 20: the range of the displacement is the theory's largest slide, and inverting the theory
// returns the friction. The velocity is exact at the lines, so that the parabola misses the turning point by
// less than 1e-4 r where the acceleration jumps from one slide to the next; dX/dmu is 2 to 5 here.
TEST(ShakeTest, GivesTheFrictionBack) {
    for (double const mu : {0.05, 0.15, 0.23, 0.3, 0.35}) {
        PointMassPhases mass = shaken(0.67, mu);
        ASSERT_EQ(mass.theory.motion.mode, "PN");
        auto const lines = relative_displacement_ranges(mass.series(5), 1, 5);
        ASSERT_EQ(lines.size(), 4u);
        for (double const line : lines) {
            double const wanted = theory::shake({0.67}, mu).max_relative_displacement;
            EXPECT_NEAR(line / PointMassPhases::amplitude, wanted, 3e-4) << mu;
        }
        auto const found = theory::friction_from_shake({0.67}, lines[0] / PointMassPhases::amplitude, 0);
        EXPECT_NEAR(found.friction, mu, 2e-4);
    }
}

TEST(ShakeTest, SeesCreep) {
    PhaseSeries series = shaken(0.67, 0.23).series(5);
    EXPECT_NEAR(creep_per_cycle(series, 1, 5), 0, 1e-6 * PointMassPhases::amplitude);
    for (std::size_t i = 0; i < series.lines(); ++i) series.x[i] += 1e-5 * static_cast<double>(i);
    EXPECT_NEAR(creep_per_cycle(series, 2, 5), 1e-3, 1e-8);
}

TEST(ShakeTest, ALayerThatGoesWithTheTroughDrawsNothing) {
    PhaseSeries series;
    for (int i = 0; i < 300; ++i) {
        series.trough_x.push_back(std::sin(0.01 * i));
        series.x.push_back(series.trough_x.back() + 1);
    }
    for (double const line : relative_displacement_ranges(series, 1, 3)) EXPECT_NEAR(line, 0, 1e-12);
    EXPECT_THROW(relative_displacement_ranges(series, 0, 3), std::invalid_argument);
    EXPECT_THROW(relative_displacement_ranges(series, 1, 4), std::invalid_argument);
    EXPECT_THROW(creep_per_cycle(series, 2, 2), std::invalid_argument);
}

}  // namespace
}  // namespace vibrotrough::measure
