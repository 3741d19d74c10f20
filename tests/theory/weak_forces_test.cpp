#include "theory/conveyor.hpp"
#include "theory/efficiency.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;
constexpr double weak[] = {1e-4, 1e-5, 1e-6};

PointMass level(double friction) {
    return {.throw_number = 2, .tan_vibration_angle = std::tan(pi / 6), .friction = friction};
}

Conveyor general(PointMass const& point, double air_drag) {
    Conveyor conveyor{};
    conveyor.point = point;
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
    }
}

// What counts is the ratio of gravity to friction. A friction of mu changes the limit by about mu.
TEST(WeakForces, GravityAndFrictionKeepTheirRatio) {
    for (double const share : {-0.9, -0.3, 0.5, 0.9}) {
        auto const efficiency = [&](double mu) {
            PointMass p = level(mu);
            p.tan_inclination = share * mu;
            return solve(p).velocity_efficiency;
        };
        EXPECT_NEAR(efficiency(1e-5), efficiency(1e-6), 2e-5) << share;
    }
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
    }
}

// The air is at rest and drag is proportional to velocity: without friction the mean velocity is zero.
TEST(WeakForces, DragAlone) {
    for (double const drag : {1e-4, 1e-6, 1e-8}) {
        auto const motion = solve(general(level(0), drag)).motion;
        EXPECT_NEAR(motion.velocity_efficiency, 0, 1e-6) << drag;
    }
}

// Beside friction such a drag changes eta by less than itself.
TEST(WeakForces, DragBesideFriction) {
    double const without = solve(level(0.3)).velocity_efficiency;
    for (double const drag : {1e-4, 1e-6, 1e-8}) {
        auto const motion = solve(general(level(0.3), drag)).motion;
        EXPECT_NEAR(motion.velocity_efficiency, without, 10 * drag + 1e-9) << drag;
        EXPECT_TRUE(motion.converged) << drag;
    }
}

}  // namespace
}  // namespace vibrotrough::theory
