#include "random_number.hpp"
#include "theory/efficiency.hpp"
#include "theory/point_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;

// beta -> 0 with Gamma -> 0 at fixed K: the normal force is constant, and reversing the inclination (alpha ->
// -alpha) reverses the motion: eta -> -eta. Tolerance: the difference from the limit is proportional to
// tan(beta).
RC_GTEST_PROP(Properties, AntisymmetricInTheInclinationAtSmallVibrationAngles, ()) {
    double const mu = between(0.05, 1), tan_beta = 1e-7, tan_alpha = between(0, 0.9) * mu,
                 k = between(1.5, 20);
    double const throw_number = k * tan_beta * mu;
    double const uphill = solve({throw_number, tan_beta, tan_alpha, mu}).velocity_efficiency;
    double const downhill = solve({throw_number, tan_beta, -tan_alpha, mu}).velocity_efficiency;
    RC_ASSERT(std::abs(uphill + downhill) < 1e-4 * (1 + k));
}

// Along a line in the space of inputs eta is continuous while the throw number stays below sqrt(1 + pi^2),
// where the landing jumps to the next cycle. Tolerance: steps of 1e-7 of the line; close to a tangency eta
// changes as the square root of the step, 3e-4, times a slope of order 10.
RC_GTEST_PROP(Properties, ContinuousAlongLinesBelowAWholeCycle, ()) {
    double const mu = between(0.1, 1), alpha = between(-0.8, 0.8) * mu, beta = between(5, 70) * pi / 180;
    double const gamma = between(0.2, 3.2), turn = between(-1, 1);
    EfficiencySolver solver;
    auto const at = [&](double s) {
        return solver({gamma + turn * s, std::tan(beta + s), alpha + 0.1 * s, mu + 0.2 * s})
            .velocity_efficiency;
    };
    RC_ASSERT(std::abs(at(1e-7) - at(0)) < 1e-2);
}

// Above this throw number eta jumps only where the mode changes: where the mass just misses the highest
// position of the trough, the flight ends in another cycle, and the order of phases or the period changes,
// too. Same tolerance; chaotic intervals (no period, or a long one) are excluded.
RC_GTEST_PROP(Properties, JumpsOnlyWhereTheModeChanges, ()) {
    double const mu = between(0.1, 1), alpha = between(-0.8, 0.8) * mu, beta = between(5, 70) * pi / 180;
    double const gamma = between(3.2, 8), turn = between(-1, 1);
    EfficiencySolver solver;
    auto const at = [&](double s) {
        return solver({gamma + turn * s, std::tan(beta + s), alpha + 0.1 * s, mu + 0.2 * s});
    };
    Efficiency const here = at(0), there = at(1e-7);
    RC_PRE(here.mode == there.mode && here.period_cycles == there.period_cycles && here.period_cycles <= 4);
    RC_PRE(here.outcome == Outcome::periodic && there.outcome == Outcome::periodic);
    RC_ASSERT(std::abs(here.velocity_efficiency - there.velocity_efficiency) < 1e-2);
}

// Any finite input gives a finite efficiency or a named outcome within bounded work, or is refused by name.
RC_GTEST_PROP(Properties, ExtremeInputsHaveAnAnswer, ()) {
    double const mu = *rc::gen::element(0.0, 1e-12, 1e-3, 0.35, 1.0, 5.0, 1e6) * between(0, 1);
    double const beta = *rc::gen::element(1e-9, 0.1, 45.0, 89.9, 89.9999) * pi / 180;
    double const gamma =
        *rc::gen::element(1e-300, 1e-9, 0.5, 1.0, 1.0 + 1e-15, 3.2969, 3.2969084, 7.0, 50.0, 1e4);
    double const alpha = *rc::gen::element(-1e6, -1.0, -1.0 + 1e-12, -1e-9, 0.0, 1e-9, 0.5, 1.0) * mu;
    PointMass const input{gamma, std::tan(beta), std::abs(alpha) <= 1e6 ? alpha : 0, mu};
    bool const refused = gamma > largest_throw_number || (mu > 0 && mu < 1e-6) ||
                         (mu > 0 && mu * input.tan_vibration_angle < 5e-9 * std::min(1.0, gamma));
    if (refused) {
        RC_ASSERT_THROWS_AS(solve(input), std::invalid_argument);
        return;
    }
    Motion const motion = solve(input);
    RC_ASSERT(!std::isnan(motion.velocity_efficiency));
    bool const unbounded = motion.outcome == Outcome::runs_away;
    RC_ASSERT(unbounded == std::isinf(motion.velocity_efficiency));
    RC_ASSERT(unbounded == (std::abs(input.tan_inclination) > mu));
    RC_ASSERT(EfficiencySolver()(input).velocity_efficiency == motion.velocity_efficiency);
}

}  // namespace
}  // namespace vibrotrough::theory
