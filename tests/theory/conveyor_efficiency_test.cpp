#include "theory/conveyor.hpp"
#include "theory/efficiency.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

constexpr double pi = std::numbers::pi;

/// Conveyors of all kinds, one after another; the throw number stays the same for some of them.
class RandomConveyors {
  public:
    Conveyor next() {
        Conveyor c{};
        double const mu = between(0.05, 0.85);
        if (maybe()) throw_number_ = std::exp(between(std::log(0.2), std::log(8.0)));
        c.point = {throw_number_, std::tan(between(2, 82) * pi / 180), between(-0.99, 0.99) * mu, mu};
        if (maybe()) c.static_friction = mu * between(1, 2);
        if (maybe()) c.restitution = between(0, 0.8) * between(0, 1);
        if (maybe()) c.landing_friction = mu * between(0, 2);
        if (maybe()) c.air_drag = std::pow(10, between(-3, 0.5));
        if (maybe()) c.along_ratio = between(-2, 2), c.along_phase = between(-4, 4);
        if (maybe()) c.normal = {{order(), between(-0.5, 0.5), between(-4, 4)}};
        if (maybe()) c.along = {{order(), between(-0.5, 0.5), between(-4, 4)}, {3, 0.2, 1}};
        if (maybe()) c.wall_friction = between(0, 1), c.height_over_width = between(0, 1);
        return c;
    }

  private:
    double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
    bool maybe() { return between(0, 1) < 0.3; }
    int order() { return static_cast<int>(between(1, 8)); }

    std::mt19937_64 random_{20261122};
    double throw_number_ = 1.5;
};

/// Whether one mode is the other one with a later start.
bool turned(std::string const& a, std::string const& b) {
    return a.size() == b.size() && (a + a).find(b) != std::string::npos;
}

// EfficiencySolver finds the phases from the zeros of the forces and the period by Newton's method;
// solve(Conveyor) walks in steps that cannot skip a zero until two periods agree. Both give the same eta.
// Tolerance: solve() accepts a period whose state repeats to 1e-11 and whose displacement repeats to 1e-9.
// Without a period, and where the mass takes more than 3000 periods to run away, solve() gives a mean.
TEST(ConveyorEfficiency, IsThatOfTheWalk) {
    RandomConveyors conveyors;
    EfficiencySolver solver;
    int periodic = 0;
    for (int i = 0; i < 1500; ++i) {
        Conveyor const c = conveyors.next();
        Efficiency const fast = solver.solve(c);
        ConveyorMotion const walk = solve(c);
        Motion const& motion = walk.motion;
        if (motion.outcome == Outcome::unsettled) continue;
        EXPECT_EQ(fast.outcome, motion.outcome) << i;
        if (motion.outcome != Outcome::periodic || fast.outcome != Outcome::periodic) continue;
        ++periodic;
        EXPECT_EQ(fast.period_cycles, motion.period_cycles) << i;
        EXPECT_NEAR(fast.velocity_efficiency, motion.velocity_efficiency,
                    1e-9 * (1 + std::abs(motion.velocity_efficiency)))
            << i << ' ' << motion.mode;
        if (motion.phases.size() > 20) continue;
        // A period of several cycles can be written down from any of its take-offs.
        std::string const mode = to_string(fast.mode);
        EXPECT_TRUE(motion.period_cycles == 1 ? mode == motion.mode : turned(mode, motion.mode))
            << i << ' ' << mode << ' ' << motion.mode;
    }
    EXPECT_GT(periodic, 1200);
}

// What the solver remembers of other points does not change an answer. Tolerance: both know eta to 1e-9.
TEST(ConveyorEfficiency, DoesNotDependOnThePointsBefore) {
    RandomConveyors conveyors;
    EfficiencySolver experienced;
    for (int i = 0; i < 400; ++i) {
        Conveyor const c = conveyors.next();
        Efficiency const one = experienced.solve(c), other = EfficiencySolver().solve(c);
        EXPECT_EQ(one.outcome, other.outcome);
        if (one.outcome != Outcome::periodic) continue;
        EXPECT_NEAR(one.velocity_efficiency, other.velocity_efficiency, 1e-9) << i;
        EXPECT_EQ(one.period_cycles, other.period_cycles);
    }
}

// A mass that never stops sliding: its mean absolute velocity follows from the mean forces, kappa u =
// -tan(beta) / Gamma (tan(alpha) - mu), and the trough has no mean velocity. Tolerance: rounding over kappa.
TEST(ConveyorEfficiency, OfASlideThatNeverEnds) {
    Conveyor c{};
    c.point = {0.3, 4.7, -0.5, 0.2};
    c.air_drag = 0.1;
    double const expected = 4.7 / 0.3 * (0.5 - 0.2) / 0.1;
    EXPECT_NEAR(EfficiencySolver().solve(c).velocity_efficiency, expected, 1e-9 * expected);
    EXPECT_NEAR(solve(c).motion.velocity_efficiency, expected, 1e-8 * expected);
    EXPECT_EQ(solve(c).motion.mode, "P");
}

}  // namespace
}  // namespace vibrotrough::theory
