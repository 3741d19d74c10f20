#include "random_number.hpp"
#include "theory/detail/plastic/contact.hpp"
#include "theory/detail/plastic/flight.hpp"
#include "theory/detail/plastic/steady_motion.hpp"
#include "theory/efficiency.hpp"
#include "theory/point_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;

PointMass ordinary_point() {
    double const mu = between(0.05, 1);
    return {between(0.2, 8), std::tan(between(2, 80) * pi / 180), between(-0.9, 0.9) * mu, mu};
}

// Friction brings different velocities closer together, so that for |tan(alpha)| < mu every initial velocity
// leads to the same motion. The test repeats the period map from another velocity. Tolerance: the convergence
// is geometric; the test is made only where the slope of the map shows that less than 1e-10 is left after
// 2000 periods.
RC_GTEST_PROP(Properties, EveryStartEndsInTheSameMotion, ()) {
    PointMass const input = ordinary_point();
    Motion const motion = solve(input);
    RC_PRE(motion.converged && motion.mode != "R");
    detail::Law const law = detail::make_law(input);
    detail::NormalMotion normal;
    if (input.throw_number > 1) {
        detail::find_normal_motion(input.throw_number, normal);
    } else {
        detail::start_at_slide(law, normal);
    }
    detail::Hints hints;
    double displacement = 0, v = between(-5, 5), before = v;
    auto const add = [&](PhaseKind, detail::Instant, detail::Instant, double moved, double) {
        displacement += moved;
    };
    for (int i = 0; i < 2000; ++i) {
        displacement = 0;
        before = v;
        v = detail::follow_period(law, normal, v, hints, add).v;
    }
    RC_PRE(std::abs(v - before) < 1e-13);
    double const eta = displacement / (normal.end.t - normal.start.t);
    RC_ASSERT(std::abs(eta - motion.velocity_efficiency) < 1e-9);
}

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

// Any finite input gives a finite efficiency or a named outcome within bounded work.
RC_GTEST_PROP(Properties, ExtremeInputsHaveAnAnswer, ()) {
    double const mu = *rc::gen::element(0.0, 1e-12, 1e-3, 0.35, 1.0, 5.0, 1e6) * between(0, 1);
    double const beta = *rc::gen::element(1e-9, 0.1, 45.0, 89.9, 89.9999) * pi / 180;
    double const gamma =
        *rc::gen::element(1e-300, 1e-9, 0.5, 1.0, 1.0 + 1e-15, 3.2969, 3.2969084, 7.0, 50.0, 1e4);
    double const alpha = *rc::gen::element(-1e6, -1.0, -1.0 + 1e-12, -1e-9, 0.0, 1e-9, 0.5, 1.0) * mu;
    PointMass const input{gamma, std::tan(beta), std::abs(alpha) <= 1e6 ? alpha : 0, mu};
    Motion const motion = solve(input);
    RC_ASSERT(!std::isnan(motion.velocity_efficiency));
    bool const unbounded = motion.outcome == Outcome::runs_away;
    RC_ASSERT(unbounded == std::isinf(motion.velocity_efficiency));
    RC_ASSERT(unbounded == (std::abs(input.tan_inclination) > mu));
    EfficiencySolver fast;
    double const eta = fast(input).velocity_efficiency;
    RC_ASSERT(std::isfinite(eta) == !unbounded);
    // Where the problem is well conditioned (see solve()) both solvers agree.
    double const friction = mu * input.tan_vibration_angle;
    bool const settled_by_friction = friction > 1e-6 * std::max(1.0, gamma) && friction < 1e4 &&
                                     std::abs(input.tan_inclination) < 0.999 * mu;
    if (!unbounded && settled_by_friction) RC_ASSERT(std::abs(eta - motion.velocity_efficiency) <= 1e-8);
}

}  // namespace
}  // namespace vibrotrough::theory
