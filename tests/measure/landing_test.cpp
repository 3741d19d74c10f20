#include "measure/landing.hpp"

#include "point_mass_phases.hpp"

#include <numbers>

#include <gtest/gtest.h>

// A point mass that moves according to the theory serves as a layer whose landing and normal force are known
// exactly.
namespace vibrotrough::measure {
namespace {

using std::numbers::pi;

SlidingMass facts_of(PointMassPhases const& mass, double friction) {
    return {PointMassPhases::mass, friction, mass.facts.gravity_x, mass.facts.frequency,
            mass.omega * mass.length_x};
}

// J_t / J_n = mu if the mass lands faster than the trough and friction does not stop it (P'): the rest of the
// interval is a slide in the same direction, so that the ratio is not affected. If the landing stops the
// slip, J_t = m times that slip; tolerance 0.01, because the interval also contains a part of the following
// slide.
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

// A layer that skips cycles takes off in either cycle of its period, by where that begins: the landing is the
// same. Tolerance: the trace of the theory is interpolated at other times, whose rounding errors are far
// smaller.
TEST(Landing, IsLookedAtInTheCycleInWhichItIs) {
    PointMassPhases skips(theory::PointMass{5.0, 0.5, 0, 0.35});
    PhaseSeries const series = skips.series(14);
    skips.facts.used = 12;
    LayerMotion const one = layer_motion(series, skips.facts);
    LayerMotion const other = layer_motion(without_first(series, PhaseSeries::per_cycle), skips.facts);
    ASSERT_EQ(one.period_cycles, 2);
    ASSERT_EQ(other.period_cycles, 2);
    EXPECT_NE(one.landing_line, other.landing_line);
    ASSERT_TRUE(landing_friction(one) && landing_friction(other));
    EXPECT_NEAR(*landing_friction(one), *landing_friction(other), 1e-6);
}

TEST(Landing, WithoutFlightThereIsNone) {
    PointMassPhases slides(theory::PointMass{0.8, 0.5, 0, 0.23});
    EXPECT_FALSE(landing_friction(layer_motion(slides.series(8), slides.facts)));
    EXPECT_FALSE(landing_friction({}));
}

// With the normal force of a point mass, a point mass moves according to the theory. The force is known as
// means over a hundredth of a cycle, so that the time of a landing is known to 0.01 cycles. The error is this
// time multiplied by the change of slip at the landing; in addition, a mass that is stopped by the landing
// sticks to the trough for up to 2 pi / 100 too long, during which the velocity of the trough changes by that
// multiplied by |sin t|. The remaining 0.001 is the error of the means where slides begin and end.
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

// Steeper than the friction angle: the mass runs away, and there is no efficiency.
TEST(Landing, AMassThatRunsAwayHasNoEfficiency) {
    PointMassPhases mass(theory::PointMass{0.8, 0.5, -0.2, 0.23});
    LayerMotion const motion = layer_motion(mass.series(8), mass.facts);
    EXPECT_FALSE(efficiency_by_normal_force(motion.curves, facts_of(mass, 0.1)));
    EXPECT_FALSE(efficiency_by_normal_force({}, facts_of(mass, 0.1)));
}

}  // namespace
}  // namespace vibrotrough::measure
