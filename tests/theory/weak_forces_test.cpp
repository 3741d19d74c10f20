#include "theory/conveyor.hpp"
#include "theory/efficiency.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;
constexpr double weak[] = {1e-6,  1e-9,   1e-12,  1e-14,  1e-15,  1e-16,
                           1e-20, 1e-100, 1e-300, 1e-308, 1e-310, 1e-320};

PointMass level(double friction) {
    return {.throw_number = 2, .tan_vibration_angle = std::tan(pi / 6), .friction = friction};
}

Conveyor general(PointMass const& point, double restitution = 0, double air_drag = 0) {
    Conveyor conveyor{};
    conveyor.point = point;
    conveyor.restitution = restitution;
    conveyor.air_drag = air_drag;
    return conveyor;
}

/// The phase of the landing: Gamma (sin t - sin d) = Gamma cos(d) (t - d) - (t - d)^2 / 2 with sin d = 1 /
/// Gamma (Eqs. 12-16 of Sloot & Kruyt), by bisection.
double landing_phase(double gamma) {
    double const d = std::asin(1 / gamma);
    auto const gap = [&](double t) {
        return gamma * std::cos(d) * (t - d) - (t - d) * (t - d) / 2 - gamma * (std::sin(t) - std::sin(d));
    };
    double low = d + 1, high = d + 6;
    while (high - low > 1e-15 * high) {
        double const middle = (low + high) / 2;
        (gap(middle) > 0 ? low : high) = middle;
        if (middle == low && middle == high) break;
    }
    return low;
}

// With vanishing friction the mass keeps one velocity over the cycle. At Gamma = 2 on a level trough the
// impulse of the landing outweighs that of the slide, so that it stops the slip: the velocity is that of the
// trough at the landing, and eta = cos(t_landing). A friction of mu changes it by about mu.
TEST(WeakForces, FrictionThatVanishesHasALimit) {
    double const limit = std::cos(landing_phase(2));
    EXPECT_NEAR(limit, 0.4529, 1e-4);
    for (double const mu : weak) {
        Motion const motion = solve(level(mu));
        EXPECT_EQ(motion.mode, "FN'") << mu;
        EXPECT_NEAR(motion.velocity_efficiency, limit, 2 * mu + 1e-7) << mu;
        EXPECT_NEAR(EfficiencySolver()(level(mu)).velocity_efficiency, limit, 2 * mu + 1e-7) << mu;
        EXPECT_NEAR(solve(general(level(mu))).motion.velocity_efficiency, limit, 2 * mu + 1e-8) << mu;
    }
}

// Where so weak a friction does not stop the mass in a cycle, the derivative of the map of the velocity is 1
// but for rounding. A step of Newton's method was made of that: it was 1e7 and seemed to be a fixed point. A
// friction of mu changes the limit by about mu.
TEST(WeakForces, TheLimitDoesNotDependOnTheFriction) {
    for (double tangent = 0.3; tangent < 1.2; tangent += 0.0371) {
        auto const efficiency = [&](double friction) {
            double const gamma = 4 * tangent / std::hypot(1, tangent);  // on a level trough with K = 4
            return solve({.throw_number = gamma, .tan_vibration_angle = tangent, .friction = friction})
                .velocity_efficiency;
        };
        double const limit = efficiency(1e-7);
        for (double const mu : {1e-9, 1e-12, 1e-18}) EXPECT_NEAR(efficiency(mu), limit, 1e-6) << tangent;
    }
}

// What counts is the ratio of gravity to friction.
TEST(WeakForces, GravityAndFrictionKeepTheirRatio) {
    for (double const share : {-0.9, -0.3, 0.5, 0.9}) {
        auto const efficiency = [&](double mu) {
            PointMass p = level(mu);
            p.tan_inclination = share * mu;
            return solve(p).velocity_efficiency;
        };
        double const expected = efficiency(1e-8);
        for (double const mu : {1e-12, 1e-15, 1e-16, 1e-30, 1e-300})
            EXPECT_NEAR(efficiency(mu), expected, 1e-6) << mu;
    }
    PointMass steep = level(1e-16);
    steep.tan_inclination = 1e-15;
    EXPECT_EQ(solve(steep).outcome, Outcome::runs_away);
}

// A drive almost along the trough: friction is weak beside the vibration normal to it, but not beside that
// along it. At K = 4 and mu = 0.3 the mass slides, and both solvers agree.
TEST(WeakForces, AreNotThoseOfAFlatDrive) {
    for (double const tan_beta : {1e-6, 1e-12, 1e-15}) {
        PointMass p{.throw_number = 4 * tan_beta,
                    .tan_vibration_angle = tan_beta,
                    .tan_inclination = 0.06,
                    .friction = 0.3};
        double const efficiency = solve(p).velocity_efficiency;
        EXPECT_LT(efficiency, -1e-3);
        EXPECT_NEAR(solve(general(p)).motion.velocity_efficiency, efficiency, 1e-6) << tan_beta;
    }
}

// With rebounds the limit is not known in closed form; it is approached linearly.
TEST(WeakForces, WithRebounds) {
    auto const efficiency = [](double mu) {
        return solve(general(level(mu), 0.3)).motion.velocity_efficiency;
    };
    for (double const mu : weak) EXPECT_NEAR(efficiency(mu), efficiency(1e-8), 1e-6 + 2 * mu) << mu;
}

// The air is at rest and drag is proportional to velocity: without friction the mean velocity is zero.
TEST(WeakForces, DragAlone) {
    for (double const drag : weak) {
        auto const motion = solve(general(level(0), 0, drag)).motion;
        EXPECT_NEAR(motion.velocity_efficiency, 0, 1e-6) << drag;
    }
}

// Beside friction such a drag changes eta by less than itself.
TEST(WeakForces, DragBesideFriction) {
    double const without = solve(level(0.3)).velocity_efficiency;
    for (double const drag : weak) {
        auto const motion = solve(general(level(0.3), 0, drag)).motion;
        EXPECT_NEAR(motion.velocity_efficiency, without, 10 * drag + 1e-9) << drag;
        EXPECT_TRUE(motion.converged) << drag;
    }
}

}  // namespace
}  // namespace vibrotrough::theory
