#include "theory/point_mass.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;

double efficiency(double throw_number, double tan_beta, double tan_alpha, double mu) {
    Motion const motion = solve({throw_number, tan_beta, tan_alpha, mu});
    EXPECT_TRUE(motion.converged);
    return motion.velocity_efficiency;
}

// Sloot & Kruyt, Table 1, column e = 0: Eqs. 6-18 at tan(beta) = 0.25, mu = 0.23.
// Tolerance: the table has three decimals; for its 0.210 at Gamma = 1.5 two independent codes give 0.209.
TEST(PointMass, ReproducesTable1) {
    double const tolerance = 0.001;
    EXPECT_NEAR(efficiency(1.5, 0.25, -0.05, 0.23), 0.477, tolerance);
    EXPECT_NEAR(efficiency(1.5, 0.25, 0, 0.23), 0.209, tolerance);
    EXPECT_NEAR(efficiency(1.5, 0.25, 0.05, 0.23), -0.065, tolerance);
    EXPECT_NEAR(efficiency(2, 0.25, -0.05, 0.23), 0.537, tolerance);
    EXPECT_NEAR(efficiency(2, 0.25, 0, 0.23), 0.517, tolerance);
    EXPECT_NEAR(efficiency(2, 0.25, 0.05, 0.23), 0.498, tolerance);
}

// The case that DEM simulations are compared with. Tolerance: four decimals are known.
TEST(PointMass, ReproducesTheCaseOfTheDem) {
    EXPECT_NEAR(efficiency(2, 0.5, 0, 0.23), 0.5815, 5e-5);
}

// Eq. 15: Gamma = sqrt(((cos 2 pi n + 2 pi^2 n^2 - 1) / (2 pi n - sin 2 pi n))^2 + 1).
// Tolerance: the given throw numbers have five decimals and d n / d Gamma < 3 there.
TEST(PointMass, FliesAsLongAsEquation15Says) {
    EXPECT_NEAR(solve({1.08057, 0.25, 0, 0.23}).flight_number, 0.25, 3e-5);
    EXPECT_NEAR(solve({1.36846, 0.25, 0, 0.23}).flight_number, 0.5, 3e-5);
    EXPECT_NEAR(solve({2.03179, 0.25, 0, 0.23}).flight_number, 0.75, 3e-5);
    for (double n = 0.001; n < 1; n += 0.001) {
        double const d = 2 * pi * n;
        double const ratio = (std::cos(d) + d * d / 2 - 1) / (d - std::sin(d));
        // In the ratio above, terms of size d^4/24 are lost against 1: the relative error is 1e-16 * 24 /
        // d^4, and n has the same error.
        double const tolerance = 1e-13 + n * 1e-15 * 24 / (d * d * d * d);
        EXPECT_NEAR(solve({std::hypot(ratio, 1), 0.25, 0, 0.23}).flight_number, n, tolerance) << n;
    }
}

// Eq. 15 at n = 1: Gamma = sqrt(1 + pi^2) = 3.297. Tolerance: rounding of Gamma times d n / d Gamma < 1.
TEST(PointMass, FliesAWholeCycleAtSqrt1PlusPiSquared) {
    Motion const motion = solve({std::sqrt(1 + pi * pi), 0.5, 0, 0.5});
    EXPECT_NEAR(motion.flight_number, 1, 1e-13);
    EXPECT_EQ(motion.mode, "F");
    EXPECT_EQ(motion.period_cycles, 1);
}

// Above this throw number the mass takes off again as it lands: a flight of exactly one cycle from the phase
// where cos(phase) = pi / Gamma. Tolerance: the period is accepted at a phase error of 1e-14, amplified by at
// most 1 / (1 - contraction).
TEST(PointMass, RelaunchesAtOnceBeyondAWholeCycle) {
    for (double const throw_number : {3.3, 3.35, 3.4, 3.6}) {
        Motion const motion = solve({throw_number, 0.5, 0, 0.5});
        ASSERT_TRUE(motion.converged) << throw_number;
        ASSERT_EQ(motion.mode, "F") << throw_number;
        EXPECT_NEAR(std::cos(motion.phases[0].start), pi / throw_number, 1e-11) << throw_number;
    }
}

TEST(PointMass, RecognisesPeriodsOfSeveralCycles) {
    Motion const motion =
        solve({4.6, 0.5, 0, 0.5});  // lands in the second cycle, at a height that the trough reaches
    ASSERT_TRUE(motion.converged);
    EXPECT_EQ(motion.period_cycles, 2);
    EXPECT_GT(motion.flight_number, 1);
    EXPECT_NEAR(motion.phases.back().end - motion.phases.front().start, 4 * pi, 1e-12);
}

// The phases of one period follow each other without gaps and their displacements sum to eta times the
// period. Tolerance: sums of a few doubles of order 10.
TEST(PointMass, PhasesCoverThePeriod) {
    for (double throw_number = 0.05; throw_number < 8; throw_number += 0.05) {
        for (double const tan_alpha : {-0.2, 0.0, 0.1}) {
            Motion const motion = solve({throw_number, 0.6, tan_alpha, 0.3});
            ASSERT_TRUE(motion.converged);
            double displacement = 0, end = motion.phases.front().start;
            EXPECT_GE(end, 0);
            EXPECT_LT(end, 2 * pi);
            for (Phase const& phase : motion.phases) {
                EXPECT_NEAR(phase.start, end, 1e-11) << throw_number;
                displacement += phase.relative_displacement;
                end = phase.end;
            }
            double const period = end - motion.phases.front().start;
            EXPECT_NEAR(period, 2 * pi * motion.period_cycles, 1e-11) << throw_number;
            EXPECT_NEAR(displacement / period, motion.velocity_efficiency, 1e-12) << throw_number;
        }
    }
}

// Eqs. 7, 8: slip does not start while (mu -/+ tan(alpha)) tan(beta) > Gamma (1 +/- mu tan(beta)).
TEST(PointMass, RestsWhenTheDriveIsWeak) {
    Motion const motion = solve({0.02, 0.25, 0, 0.23});
    EXPECT_EQ(motion.mode, "R");
    EXPECT_TRUE(motion.converged);
    EXPECT_EQ(motion.velocity_efficiency, 0);
    EXPECT_EQ(motion.flight_number, 0);
}

TEST(PointMass, NamesMotionsThatDoNotSettle) {
    Motion const downhill = solve({2, 0.25, 0.3, 0.23});
    EXPECT_EQ(downhill.outcome, Outcome::runs_away);
    EXPECT_FALSE(downhill.converged);
    EXPECT_EQ(downhill.velocity_efficiency, -std::numeric_limits<double>::infinity());
    Motion const forward = solve({2, 0.25, -0.3, 0.23});
    EXPECT_EQ(forward.velocity_efficiency, std::numeric_limits<double>::infinity());
    Motion const slippery = solve({2, 0.25, 0, 0});
    EXPECT_EQ(slippery.outcome, Outcome::indifferent);
    EXPECT_FALSE(slippery.converged);
    EXPECT_EQ(slippery.velocity_efficiency, 0);
}

TEST(PointMass, HoldsWithSteepVibrationAndStrongFriction) {
    for (double throw_number = 0.1; throw_number < 50; throw_number *= 1.1) {
        for (double const tan_beta : {1e-3, 2.0, 572.957}) {  // up to 89.9 degrees: mu tan(beta) >> 1
            for (double const tan_alpha : {-4.999, -1.0, 0.0, 3.0}) {
                Motion const motion = solve({throw_number, tan_beta, tan_alpha, 5});
                EXPECT_TRUE(std::isfinite(motion.velocity_efficiency)) << throw_number << ' ' << tan_beta;
            }
        }
    }
}

TEST(PointMass, RefusesWhatIsOutOfRange) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(solve({0, 0.25, 0, 0.23}), std::invalid_argument);
    EXPECT_THROW(solve({2, 0, 0, 0.23}), std::invalid_argument);
    EXPECT_THROW(solve({2, 0.25, nan, 0.23}), std::invalid_argument);
    EXPECT_THROW(solve({2, 0.25, 0, -0.1}), std::invalid_argument);
    EXPECT_THROW(solve({nan, 0.25, 0, 0.23}), std::invalid_argument);
}

// K = omega^2 r / g = Gamma cos(alpha) / sin(beta). Tolerance: rounding.
TEST(PointMass, GivesTheMachineNumber) {
    EXPECT_NEAR(machine_number({2, std::tan(pi / 6), 0, 0.3}), 4, 1e-14);
    EXPECT_NEAR(machine_number({2, std::tan(pi / 6), std::tan(pi / 3), 0.3}), 2, 1e-14);
}

}  // namespace
}  // namespace vibrotrough::theory
