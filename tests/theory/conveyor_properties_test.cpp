#include "random_number.hpp"
#include "theory/conveyor.hpp"
#include "theory/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;

bool maybe() {
    return *rc::gen::arbitrary<bool>();
}

Conveyor extreme_conveyor() {
    Conveyor c{};
    double const mu = *rc::gen::element(0.0, 2e-6, 0.35, 1.0, 5.0) * between(0.5, 1);
    double const beta = *rc::gen::element(1e-6, 0.1, 30.0, 80.0, 89.9) * pi / 180;
    double const gamma = *rc::gen::element(1e-6, 0.3, 1.0, 1.0 + 1e-12, 2.0, 3.2969084, 7.0, 50.0);
    c.point = {gamma, std::tan(beta), *rc::gen::element(-1.5, -1.0, -0.3, 0.0, 0.3, 1.0) * mu, mu};
    if (maybe()) c.static_friction = mu * *rc::gen::element(1.0, 1.3, 10.0);
    if (maybe()) c.restitution = *rc::gen::element(0.01, 0.3, 0.9);
    if (maybe()) c.landing_friction = mu * *rc::gen::element(0.0, 0.3, 2.0);
    if (maybe()) c.air_drag = *rc::gen::element(1e-8, 1e-3, 1.0, 100.0);
    if (maybe()) c.along_ratio = *rc::gen::element(0.0, -1.0, 3.0), c.along_phase = between(-4, 4);
    if (maybe()) c.normal = {{*rc::gen::inRange(1, 12), between(-2, 2), between(-4, 4)}};
    if (maybe()) c.along = {{*rc::gen::inRange(1, 12), between(-2, 2), between(-4, 4)}};
    if (maybe()) c.wall_friction = between(0, 1), c.height_over_width = *rc::gen::element(0.1, 10.0);
    return c;
}

// Any combination of inputs gives a finite efficiency, an interval or a named outcome within bounded work, or
// is refused because friction would be too weak.
RC_GTEST_PROP(ConveyorProperties, ExtremeInputsHaveAnAnswer, ()) {
    Conveyor const c = extreme_conveyor();
    EffectiveFriction const friction = effective_friction(c);
    double const strongest =
        std::max({friction.kinetic_friction, friction.static_friction, friction.landing_friction});
    double const effect = strongest * c.point.tan_vibration_angle / std::min(1.0, c.point.throw_number);
    if (effect > 0 && effect < 5e-9) {
        RC_ASSERT_THROWS_AS(solve(c), std::invalid_argument);
        return;
    }
    ConveyorMotion const motion = solve(c);
    RC_ASSERT(!std::isnan(motion.motion.velocity_efficiency));
    RC_ASSERT(std::isinf(motion.motion.velocity_efficiency) == (motion.motion.outcome == Outcome::runs_away));
    RC_ASSERT(motion.half_width >= 0);
    RC_ASSERT(motion.motion.converged == (motion.motion.outcome == Outcome::periodic));
    RC_ASSERT(!motion.motion.converged || motion.half_width == 0);
}

}  // namespace
}  // namespace vibrotrough::theory
