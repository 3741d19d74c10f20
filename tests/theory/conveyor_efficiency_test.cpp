#include "theory/conveyor.hpp"
#include "theory/detail/wave.hpp"
#include "theory/efficiency.hpp"
#include "walked_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;

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
        ConveyorMotion const walk = walked_motion(c);
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
    EXPECT_NEAR(walked_motion(c).motion.velocity_efficiency, expected, 1e-8 * expected);
    EXPECT_EQ(solve(c).motion.mode, "P");
}

// Without a period both solvers give means of chaotic motions that have nothing but the machine in common:
// they differ by less than their intervals together, and the fast one stops when its half-width is 0.01 or
// after as many cycles as the other one. Allowed to fail: one of the 95 % intervals of about ten motions.
TEST(ConveyorEfficiency, KnowsTheMeanWithoutAPeriod) {
    int without = 0, apart = 0;
    EfficiencySolver solver;
    for (double throw_number = 4; throw_number < 8; throw_number += 0.25) {
        Conveyor c{};
        c.point = {throw_number, 0.5, 0, 0.3};
        c.restitution = 0.8;
        Efficiency const fast = solver.solve(c);
        ConveyorMotion const walk = walked_motion(c);
        if (walk.motion.outcome != Outcome::unsettled) continue;
        ++without;
        EXPECT_EQ(fast.outcome, Outcome::unsettled);
        EXPECT_GT(fast.half_width, 0);
        EXPECT_LT(fast.half_width, 0.2);
        double const differ = std::abs(fast.velocity_efficiency - walk.motion.velocity_efficiency);
        apart += differ > fast.half_width + walk.half_width ? 1 : 0;
    }
    EXPECT_GT(without, 5);
    EXPECT_LE(apart, 1);
}

// Where rounding decides whether a period counts (one motion in fifteen here), both solvers compare two
// periods with rounding errors of their own, and also say which motions have none. Tolerance: each solver
// knows a periodic motion to 1e-9. Two of 150 are allowed to repeat to just below 1e-9 in one solver and to
// just above it in the other; the efficiency of the one is then within the interval of the other. Means are
// not compared here: where rounding decides what follows a contact, they are means over the rounding errors
// of each solver.
TEST(ConveyorEfficiency, AgreesWithTheWalkWhichMotionsHaveAPeriod) {
    int without = 0, marginal = 0;
    EfficiencySolver solver;
    for (int i = 0; i < 150; ++i) {
        Conveyor c{};
        c.point = {1.5 + 3.5 * i / 150, 0.6, -0.1, 0.35};
        c.restitution = 0.5;
        Efficiency const fast = solver.solve(c);
        ConveyorMotion const walk = walked_motion(c);
        Motion const& motion = walk.motion;
        if (fast.outcome != motion.outcome) {
            ++marginal;
            EXPECT_NEAR(fast.velocity_efficiency, motion.velocity_efficiency,
                        std::max(fast.half_width, walk.half_width))
                << i;
            continue;
        }
        EXPECT_EQ(fast.period_cycles, motion.period_cycles) << i;
        if (motion.outcome == Outcome::periodic) {
            EXPECT_NEAR(fast.velocity_efficiency, motion.velocity_efficiency, 2e-9) << i;
        }
        without += motion.outcome == Outcome::unsettled ? 1 : 0;
    }
    EXPECT_LE(marginal, 2);
    EXPECT_GT(without, 20);
    EXPECT_LT(without, 100);
}

// A sum with overtones has a zero wherever 20000 equal steps show a change of sign, and nowhere else. Between
// zeros the sign is the one that the section says. Tolerance: rounding of a sum of order 10 with derivatives
// up to 100.
TEST(Crossings, AreAllZerosOfASum) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<> number(-1, 1);
    for (int i = 0; i < 200; ++i) {
        detail::Wave wave;
        wave.constant = number(random);
        wave.sine = number(random);
        wave.cosine = number(random);
        if (i % 4 != 0)
            wave.overtones = {{2 + i % 3, number(random), number(random)}, {10, 0.1, number(random)}};
        detail::Crossings crossings;
        crossings.find(wave);
        int changes = 0;
        for (int k = 0; k < 20000; ++k) {
            double const a = 2 * pi * k / 20000, b = 2 * pi * (k + 1) / 20000;
            bool const before = wave(detail::Instant::at(a)) > 0, after = wave(detail::Instant::at(b)) > 0;
            changes += before != after ? 1 : 0;
            auto const section = crossings.at((a + b) / 2 + 2 * pi * (i % 3));
            EXPECT_TRUE(before != after || section.positive == before) << i << ' ' << k;
        }
        EXPECT_EQ(crossings.count(), static_cast<std::size_t>(changes)) << i;
        for (auto const& zero : crossings.zeros()) EXPECT_NEAR(wave(zero), 0, 1e-13);
    }
}

}  // namespace
}  // namespace vibrotrough::theory
