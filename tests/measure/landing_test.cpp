#include "measure/landing.hpp"

#include "point_mass_phases.hpp"

#include <gtest/gtest.h>

// A point mass that moves as the theory says is a layer whose landing and whose normal force are known.
namespace vibrotrough::measure {
namespace {

constexpr double pi = std::numbers::pi;

SlidingMass facts_of(PointMassPhases const& mass, double friction) {
    return {PointMassPhases::mass, friction, mass.facts.gravity_x, mass.facts.frequency,
            mass.omega * mass.length_x};
}

// J_t / J_n = mu where the mass lands ahead of the trough and friction does not stop it (P'): the rest of the
// interval is a slide of the same direction, so nothing is lost. Where the landing stops the slip, J_t = m
// times that slip; 0.01, because the interval holds a piece of the slide that follows, too.
TEST(Landing, FrictionOfAPointMassIsMu) {
    for (double const mu : {0.1, 0.23}) {
        PointMassPhases ahead(theory::PointMass{1.5, 0.5, 0, mu});
        ASSERT_EQ(ahead.theory.motion.mode, "FP'N");
        EXPECT_NEAR(landing_friction(layer_motion(ahead.series(8), ahead.facts)).value(), mu, 1e-6);
    }
    PointMassPhases stopped(theory::PointMass{2.0, 1.0, 0, 0.1});
    ASSERT_EQ(stopped.theory.motion.mode, "FN'");
    auto const& impact = stopped.theory.impacts.at(0);
    EXPECT_NEAR(
        landing_friction(layer_motion(stopped.series(8), stopped.facts)).value(),
        (impact.along_before - impact.along_after) * stopped.length_x / (impact.approach * stopped.length_z),
        0.01);
}

TEST(Landing, WithoutFlightThereIsNone) {
    PointMassPhases slides(theory::PointMass{0.8, 0.5, 0, 0.23});
    EXPECT_FALSE(landing_friction(layer_motion(slides.series(8), slides.facts)));
    EXPECT_FALSE(landing_friction({}));
}

// Under the normal force of a point mass, a point mass moves as the theory says. The force is known as means
// over a hundredth of a cycle, so that a landing is anywhere within one: 0.01 cycles times what it changes of
// the slip, and a mass that it stops is held to the trough up to 2 pi / 100 too long, in which the trough's
// velocity changes by that times |sin t|. The rest, 0.001, is what the means lose where slides begin and end.
TEST(Landing, ThePointMassUnderItsOwnForceIsTheTheorys) {
    for (double const gamma : {0.8, 1.2, 1.5, 1.7, 2.0, 2.5}) {
        for (double const tan_alpha : {-0.05, 0.0, 0.05}) {
            PointMassPhases mass(theory::PointMass{gamma, 0.5, tan_alpha, 0.23});
            LayerMotion const motion = layer_motion(mass.series(8), mass.facts);
            double change = 0;
            for (theory::Impact const& one : mass.theory.impacts) {
                change += std::abs(one.along_after - one.along_before);
                if (one.along_after == 0) change += 2 * pi * std::abs(std::sin(one.t));
            }
            EXPECT_NEAR(efficiency_by_normal_force(motion.curves, facts_of(mass, 0.23)).value(),
                        mass.theory.motion.velocity_efficiency, 0.001 + 0.01 * change)
                << gamma << ' ' << tan_alpha << ' ' << mass.theory.motion.mode;
        }
    }
}

// Steeper than friction holds: it runs away, and there is no number.
TEST(Landing, AMassThatRunsAwayHasNoEfficiency) {
    PointMassPhases mass(theory::PointMass{0.8, 0.5, -0.2, 0.23});
    LayerMotion const motion = layer_motion(mass.series(8), mass.facts);
    EXPECT_FALSE(efficiency_by_normal_force(motion.curves, facts_of(mass, 0.1)));
    EXPECT_FALSE(efficiency_by_normal_force({}, facts_of(mass, 0.1)));
}

}  // namespace
}  // namespace vibrotrough::measure
