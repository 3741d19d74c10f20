#include "theory/limits.hpp"

#include "theory/friction_test.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;

// Eq. 15 against its inverse, which the solver computes. Tolerance: rounding.
TEST(Limits, FlightOfEquation15) {
    EXPECT_NEAR(throw_number_of_flight(1), std::sqrt(1 + pi * pi), 1e-14);
    EXPECT_NEAR(throw_number_of_flight(0.25), 1.08057, 5e-6);
    EXPECT_NEAR(throw_number_of_flight(0.5), 1.36846, 5e-6);
    EXPECT_NEAR(throw_number_of_flight(0.75), 2.03179, 5e-6);
    EXPECT_EQ(throw_number_of_flight(0), 1);
}

// The paper's value 2.975, and the optimum that the solver finds at small beta. Tolerances: the digits of the
// paper; 1e-7 of Brent's method plus a shift proportional to mu tan(beta) = 1e-6.
TEST(Limits, BestThrowNumber) {
    double const limit = best_throw_number_small_angle();
    EXPECT_NEAR(limit, 2.975, 0.0006);
    for (double const tan_alpha : {-0.1, 0.0, 0.1}) {
        EXPECT_NEAR(best_throw_number(1e-6, tan_alpha, 0.35).throw_number, limit, 1e-4) << tan_alpha;
    }
    // At finite mu tan(beta) the optimum is higher, about 3.05 at tan(beta) = mu = 0.5 (two digits are
    // known).
    EXPECT_NEAR(best_throw_number(0.5, 0, 0.5).throw_number, 3.05, 0.01);
    EXPECT_THROW(best_throw_number(0.5, 0.4, 0.3), std::invalid_argument);
}

// eta = cos(delta_F) at Gamma = sqrt(1 + pi^2), where the mass lands at the phase of take-off, so that the
// contact has no duration: 0.9529. Tolerance: rounding.
TEST(Limits, EfficiencyAtAFlightOfOneCycle) {
    double const gamma = throw_number_of_flight(1);
    double const expected = std::cos(std::asin(1 / gamma));
    EXPECT_NEAR(solve({gamma, 0.3, 0, 0.35}).velocity_efficiency, expected, 1e-12);
    EXPECT_NEAR(expected, 0.9529, 5e-5);
}

// Eq. 20 agrees with the solver wherever it applies, and has no value elsewhere. Tolerance: 1e-9 of solve().
TEST(Limits, PnModeInClosedForm) {
    int applies = 0;
    for (double gamma = 0.02; gamma <= 1; gamma += 0.02) {
        for (double const tan_beta : {0.02, 0.1, 0.3, 1.0}) {
            for (double const tan_alpha : {-0.15, -0.05, 0.0, 0.1}) {
                PointMass const point{gamma, tan_beta, tan_alpha, 0.35};
                Motion const motion = solve(point);
                auto const closed = pn_motion(point);
                EXPECT_EQ(closed.has_value(), motion.mode == "PN")
                    << gamma << ' ' << tan_beta << ' ' << tan_alpha;
                if (!closed) continue;
                ++applies;
                EXPECT_NEAR(closed->velocity_efficiency, motion.velocity_efficiency, 1e-9);
                EXPECT_NEAR(closed->positive_displacement, motion.phases[0].relative_displacement, 1e-9);
            }
        }
    }
    EXPECT_GT(applies, 50);
}

// Eq. 21: eta -> - sin(pi tan(alpha) / (2 mu)) for beta -> 0, K -> infinity, Gamma <= 1; 0.434 at -0.10,
// 0.35. Tolerance: the distance to the limit is tan(beta) = 1e-6 and 1/K = 1e-6.
TEST(Limits, SmallVibrationAngles) {
    EXPECT_NEAR(small_angle_efficiency(-0.1, 0.35), 0.434, 0.0005);
    for (double const tan_alpha : {-0.3, -0.1, 0.0, 0.05, 0.2}) {
        EXPECT_NEAR(solve({1, 1e-6, tan_alpha, 0.35}).velocity_efficiency,
                    small_angle_efficiency(tan_alpha, 0.35), 1e-5);
        EXPECT_EQ(small_angle_efficiency(tan_alpha, 0.35), -small_angle_efficiency(-tan_alpha, 0.35));
    }
    EXPECT_THROW(small_angle_efficiency(0.4, 0.35), std::invalid_argument);
}

// At beta = 0, alpha = 0 the mode changes from PRNR to PN at K = mu sqrt(1 + pi^2/4) (0.652 at mu = 0.35).
// Tolerance: the step on either side.
TEST(Limits, PnModeBeginsWhereTheClosedFormSays) {
    EXPECT_NEAR(pn_machine_number(0.35), 0.652, 0.0005);
    for (double const mu : {0.1, 0.35, 0.8}) {
        double const k = pn_machine_number(mu);
        EXPECT_EQ(shake({k * (1 - 1e-6)}, mu).mode, "PRNR");
        EXPECT_EQ(shake({k * (1 + 1e-6)}, mu).mode, "PN");
    }
}

// beta = 0, alpha = 0 in the PN mode, by Eqs. 10 and 20: C = pi, cos(d_P) = pi mu/(2 K), and
// X = 2 sin d_P + pi cos d_P - pi^2 mu / (2 K) = 2 sin d_P = 2 sqrt(1 - (pi mu / (2 K))^2). Tolerance: that
// of solve().
TEST(FrictionTest, ForwardCurveInThePnMode) {
    for (double const mu : {0.1, 0.2, 0.35}) {
        for (double const k : {0.7, 1.0, 2.0}) {
            ShakeMotion const motion = shake({k}, mu);
            ASSERT_EQ(motion.mode, "PN");
            double const part = pi * mu / (2 * k);
            EXPECT_NEAR(motion.max_relative_displacement, 2 * std::sqrt(1 - part * part), 1e-9);
        }
    }
}

// friction_from_shake() inverts shake(), also for the interval. Tolerance: the accuracy 2^-45 of the root
// divided by the slope.
TEST(FrictionTest, InverseUndoesTheForwardCurve) {
    for (double const tan_alpha : {0.0, 0.05}) {
        for (double const mu : {0.12, 0.2, 0.3, 0.5, 0.8}) {
            for (double const k : {0.9, 1.5, 3.0}) {
                ShakeTest const test{k, tan_alpha};
                double const x = shake(test, mu).max_relative_displacement;
                if (x < 0.05) continue;
                FrictionEstimate const estimate = friction_from_shake(test, x, 0.01);
                EXPECT_NEAR(estimate.friction, mu, 1e-6);
                EXPECT_LT(estimate.low, mu);
                EXPECT_GT(estimate.high, mu);
                EXPECT_NEAR(shake(test, estimate.high.value()).max_relative_displacement, x - 0.01, 1e-6);
            }
        }
    }
    // With a displacement of 0 in the interval every mu from K on is possible.
    for (double const uncertainty : {0.01, 0.05}) {
        FrictionEstimate const open = friction_from_shake({1.5}, 0.01, uncertainty);
        EXPECT_FALSE(open.high);
        EXPECT_LT(open.low, open.friction);
    }
    EXPECT_THROW(friction_from_shake({1}, 2.5, 0), std::invalid_argument);
    EXPECT_THROW(friction_from_shake({1}, 0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace vibrotrough::theory
