#include "bouncing_mass.hpp"
#include "theory/efficiency.hpp"
#include "walked_motion.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

// Values that no machine has are solved by the same solver, or refused by name.

namespace vibrotrough::theory {
namespace {

class Random {
  public:
    explicit Random(unsigned seed) : random_(seed) {}
    double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
    double over_decades(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }

  private:
    std::mt19937_64 random_;
};

Conveyor usual(Random& random) {
    double const mu = random.between(0.05, 0.85);
    Conveyor c{};
    c.point = {random.over_decades(0.2, 3.2), random.between(0.05, 3), random.between(-0.9, 0.9) * mu, mu};
    return c;
}

// One value is far beyond the usual: the walk finds the same motion. Tolerance: the walk accepts a state that
// repeats to 1e-11 in units of the trough's velocity, of which eta is a multiple here.
TEST(ExtremeInputs, HaveTheMotionThatTheWalkFinds) {
    Random random(1);
    EfficiencySolver solver;
    int compared = 0;
    for (int i = 0; i < 400; ++i) {
        Conveyor c = usual(random);
        switch (i % 8) {
            case 0:
                c.point.throw_number = random.over_decades(1e-12, 1e-3);
                break;
            case 1:
                c.point.tan_vibration_angle = random.over_decades(1e3, 1e6);
                break;
            case 2:
                c.point.friction = random.over_decades(10, 1e6);
                break;
            case 3:
                c.air_drag = random.over_decades(10, 1e3);
                break;
            case 4:
                c.air_drag = random.over_decades(1e-8, 1e-5);
                break;
            case 5:
                c.landing_friction = random.over_decades(10, 1e6);
                break;
            case 6:
                c.slowest_rebound = random.over_decades(1e-9, 1e-7), c.restitution = 0.3;
                break;
            default:
                c.flight_start = FlightStart::trough_velocity_rule;
                break;
        }
        Efficiency const found = solver.solve(c);
        Motion const walk = walked_motion(c).motion;
        if (walk.outcome != Outcome::periodic || found.outcome != Outcome::periodic) continue;
        ++compared;
        EXPECT_NEAR(found.velocity_efficiency, walk.velocity_efficiency,
                    1e-8 * (1 + std::abs(walk.velocity_efficiency)))
            << i << ' ' << to_string(found.mode);
    }
    EXPECT_GT(compared, 350);
}

// A plastic mass that flies for up to thirty cycles, beside another simulator over a hundred flights.
// Tolerance: a part of a period at both ends of a mean.
TEST(ExtremeInputs, OfLongFlights) {
    Random random(3);
    int periodic = 0;
    for (int i = 0; i < 30; ++i) {
        Conveyor c = usual(random);
        c.point.throw_number = random.over_decades(20, 100);
        Efficiency const found = EfficiencySolver().solve(c);
        if (found.outcome != Outcome::periodic) continue;
        ++periodic;
        BouncingMass<double> mass(c);
        mass.follow(20 * c.point.throw_number);
        double const expected = mass.follow(200 * c.point.throw_number);
        EXPECT_NEAR(found.velocity_efficiency, expected, 1e-3 * (1 + std::abs(expected)))
            << i << ' ' << c.point.throw_number;
    }
    EXPECT_GT(periodic, 25);
}

// A mass that impacts hardly slow down: the interval is that of a mean over all of its energies. At most one
// in five of the means of another simulator lies outside; such motions change their manner rarely.
TEST(ExtremeInputs, OfRestitutionsNearOne) {
    Random random(4);
    int held = 0, count = 0;
    while (count < 20) {
        Conveyor c = usual(random);
        c.point.throw_number = random.between(2, 8);
        c.restitution = random.between(0.9, 0.95);
        Efficiency const found = EfficiencySolver().solve(c);
        if (found.outcome != Outcome::unsettled) continue;
        ++count;
        double const flight = c.point.throw_number / std::sqrt(1 - c.restitution);  // cycles, about
        double const settling = flight / (1 - c.restitution);
        BouncingMass<double> mass(c, 1e-12);
        mass.follow(10 * settling);
        double const expected = mass.follow(100 * settling);
        held += std::abs(found.velocity_efficiency - expected) <= found.half_width ? 1 : 0;
    }
    EXPECT_GE(held, 16);
}

// Where landings hold less than slides, gravity wins although slides alone would hold the mass. The walk took
// this motion, faster from cycle to cycle, for one without a period.
TEST(ExtremeInputs, RunAwayOverLandings) {
    Conveyor c{};
    c.point = {3.6633447666, 0.2926770858, -0.0670685544, 0.1747870893};
    c.static_friction = 0.2323966130;
    c.landing_friction = 0.0638663398;
    EXPECT_EQ(EfficiencySolver().solve(c).outcome, Outcome::runs_away);
    c.landing_friction = 0.08;
    EXPECT_EQ(EfficiencySolver().solve(c).outcome, Outcome::periodic);
}

// Where gravity is exactly as strong as friction, any speed persists from the slowest one on at which nothing
// stops the mass, and from rest it comes to this one: the limit of slopes that are less steep.
TEST(ExtremeInputs, OnASlopeAsSteepAsFriction) {
    EfficiencySolver solver;
    for (double const throw_number : {0.8, 1.7, 3.3}) {
        Conveyor c{};
        c.point = {throw_number, 1.5, -0.3, 0.3};
        double const limit = solver.solve(c).velocity_efficiency;
        for (double const below : {1e-6, 1e-8, 1e-10, 1e-12}) {
            c.point.tan_inclination = -0.3 * (1 - below);
            // The speed is missed by the power 2/3 of what friction has more.
            EXPECT_NEAR(solver.solve(c).velocity_efficiency, limit, 20 * std::pow(below, 2.0 / 3) + 1e-6)
                << throw_number << ' ' << below;
        }
    }
}

TEST(ExtremeInputs, AreRefusedByName) {
    auto const refused = [](auto const& change) -> std::string {
        Conveyor c{};
        c.point = {2, 0.5, 0, 0.3};
        change(c);
        try {
            EfficiencySolver().solve(c);
        } catch (std::invalid_argument const& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refused([](Conveyor& c) { c.point.throw_number = 1e4; }),
              "throw_number = 10000 is outside its range (0, 100]");
    EXPECT_EQ(refused([](Conveyor& c) { c.point.friction = 1e-320; }),
              "friction = 9.99989e-321 is outside its range 0 or [1e-6, 1e6]");
    EXPECT_EQ(refused([](Conveyor& c) { c.point.tan_vibration_angle = 1e-9; }),
              "friction * tan_vibration_angle / min(throw_number, 1) = 3e-10 is outside its range 0 or "
              "[5e-9, inf)");
    EXPECT_EQ(refused([](Conveyor& c) { c.restitution = 0.98; }),
              "restitution = 0.98 is outside its range [0, 0.95]");
    EXPECT_EQ(refused([](Conveyor& c) {
                  c.along = {{101, 0.1, 0}};
              }),
              "order = 101 is outside its range [1, 100]");
    EXPECT_EQ(refused([](Conveyor& c) {
                  c.normal = {{2, -101, 0}};
              }),
              "amplitude = -101 is outside its range [-100, 100]");
}

}  // namespace
}  // namespace vibrotrough::theory
