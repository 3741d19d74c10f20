#include "prepare/contact.hpp"

#include "prepare/prepared_case.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::prepare {
namespace {

using std::numbers::pi;

scenario::Scenario with_engine(std::string const& engine = "") {
    return scenario::parse_campaign(example_campaign + "[engine]\n" + engine, "test.toml").cases.front();
}

// E* = 5e6 / (2 (1 - 0.35^2)) = 2.849003e6 Pa, evaluated by hand.
constexpr double effective = 2.849003e6;

TEST(Contact, PairsOfSpheres) {
    scenario::Grains const grains = with_engine().grains;
    double const mass = 1400 * pi / 6 * 27e-9;
    EXPECT_NEAR(two_grains(grains, 0.0015).mass, mass / 2, 1e-12 * mass);
    EXPECT_DOUBLE_EQ(two_grains(grains, 0.0015).radius, 0.00075);
    EXPECT_NEAR(effective_modulus(grains), effective, 1);
}

// m* v^2 / 2 = 8/15 E* sqrt(R*) d^(5/2) gives the largest overlap d of Hertz. The spring stores the same
// energy at the same overlap: k d^2 / 2. E* has seven digits here.
TEST(Contact, TheSpringOfHookeHoldsTheEnergyOfHertz) {
    scenario::Grains const grains = with_engine().grains;
    for (double const speed : {0.1, 0.7, 3.0}) {
        ContactPair const pair = two_grains(grains, 0.0015);
        double const energy = pair.mass * speed * speed / 2;
        double const overlap = std::pow(15.0 / 8 * energy / (effective * std::sqrt(pair.radius)), 0.4);
        EXPECT_NEAR(hooke_stiffness(grains, pair, speed) * overlap * overlap / 2, energy, 1e-6 * energy);
    }
}

struct Impact {
    double duration, restitution;
};

/// The impact of mass 1 with speed 1 on the spring k = 1, by small steps of the middle-point rule.
Impact integrate(double damping_ratio) {
    double const step = 1e-5;
    double overlap = 0, speed = 1, time = 0;
    auto const force = [&](double d, double v) { return d + 2 * damping_ratio * v; };
    do {
        double const middle = overlap + step / 2 * speed;
        double const middle_speed = speed - step / 2 * force(overlap, speed);
        overlap += step * middle_speed;
        speed -= step * force(middle, middle_speed);
        time += step;
    } while (force(overlap, speed) > 0);
    return {time, -speed};
}

// d'' = -(d + 2 z d') until the force would attract. The time is known to one step of 1e-5.
TEST(Contact, ALinearImpactEndsWhenItsForceDoes) {
    for (double const restitution : {0.22, 0.3, 0.5, 0.9}) {
        double const ratio = damping_ratio(restitution);
        Impact const steps = integrate(ratio);
        EXPECT_NEAR(linear_duration(1, 1, ratio), steps.duration, 2e-5) << restitution;
        EXPECT_NEAR(restitution, steps.restitution, 2e-5);
    }
    // Without damping it is half a period, pi sqrt(m / k).
    EXPECT_NEAR(linear_duration(4, 1, damping_ratio(1)), pi / 2, 1e-12);
}

/// What a nominal coefficient of the engine really gives: the inverse of nominal_restitution().
double real_restitution(double nominal) {
    double const loss = std::log(nominal);
    return restitution_of(-loss / std::hypot(pi, loss));
}

// Measured with the engine (an issue of this project): a sphere at 1 m/s comes back with 0.325 for a nominal
// 0.2 and with 0.808 for 0.8, to three digits.
TEST(Contact, NominalAndRealRestitution) {
    EXPECT_NEAR(real_restitution(0.2), 0.325, 5e-4);
    EXPECT_NEAR(real_restitution(0.8), 0.808, 5e-4);
    EXPECT_NEAR(real_restitution(0.05), least_restitution, 5e-5);
    // The Runge-Kutta integration of the damped Hertz contact that tests/engine/contact_law_test.cpp quotes.
    EXPECT_NEAR(real_restitution(0.1), 0.25273, 2e-5);
    EXPECT_NEAR(real_restitution(0.5), 0.55029, 2e-5);
    EXPECT_NEAR(real_restitution(0.9), 0.90203, 2e-5);
    EXPECT_EQ(nominal_restitution(1), 1);
    for (double const e : {0.22, 0.3, 0.5, 0.8, 0.95, 0.999})
        EXPECT_NEAR(real_restitution(nominal_restitution(e)), e, 1e-12);
}

/// Net force of Hertz and sjkr on a pair, N, with the energy density w.
double net_force(ContactPair const& pair, double w, double overlap) {
    return 4.0 / 3 * effective * std::sqrt(pair.radius) * std::pow(overlap, 1.5) -
           2 * pi * pair.radius * w * overlap;
}

// The pull-off force is the depth of the net force's minimum, looked for in steps of 1/1000 of its place.
TEST(Contact, PullOffIsTheLeastNetForce) {
    scenario::Scenario s = with_engine();
    ContactPair const pair = two_grains(s.grains, 0.0015);
    for (double const w : {1e4, 5e4, 2e5}) {
        double least = 0;
        double const place = std::pow(pi * w / effective, 2) * pair.radius;
        for (int i = 0; i < 3000; ++i) least = std::min(least, net_force(pair, w, place * i / 1000));
        s.engine.cohesion = w;
        EXPECT_NEAR(contact_of(s, 1)->pull_off_force(pair), -least, 1e-5 * -least);
    }
    s.engine.cohesion = 0;
    EXPECT_EQ(contact_of(s, 1)->pull_off_force(pair), 0);
}

// 4/3 E* sqrt(R*) d^(3/2) - 2 pi R* w d = F. E* has seven digits here, so that the two parts, which may be
// much larger than F, cancel to 1e-6 of either.
TEST(Contact, OverlapBalancesSpringAttractionAndForce) {
    for (char const* cohesion : {"0 J/m3", "20 kJ/m3", "200 kJ/m3"}) {
        scenario::Scenario const s = with_engine(std::string("cohesion = \"") + cohesion + "\"\n");
        ContactPair const pair = two_grains(s.grains, 0.0015);
        for (double const force : {0.0, 1e-4, 1e-2}) {
            double const overlap = contact_of(s, 1)->overlap_under(pair, force);
            double const part = force + 2 * pi * pair.radius * s.engine.cohesion * overlap;
            EXPECT_NEAR(net_force(pair, s.engine.cohesion, overlap), force, 1e-6 * part);
        }
    }
    // Hooke: (k - 2 pi R* w) d = F; no balance when the attraction is stronger than the spring.
    scenario::Scenario s = with_engine("contact = \"hooke\"\ncohesion = \"20 kJ/m3\"\n");
    ContactPair const pair = two_grains(s.grains, 0.0015);
    double const net = hooke_stiffness(s.grains, pair, 1) - 2 * pi * pair.radius * 2e4;
    EXPECT_NEAR(contact_of(s, 1)->overlap_under(pair, 1e-3), 1e-3 / net, 1e-12);
    s.engine.cohesion = 1e8;
    EXPECT_TRUE(std::isinf(contact_of(s, 1)->overlap_under(pair, 1e-3)));
}

// m v^2 / 2 + pi R* w d^2 = 8/15 E* sqrt(R*) d^(5/2).
TEST(Contact, AttractionDeepensAnImpact) {
    scenario::Scenario const s = with_engine("cohesion = \"100 kJ/m3\"\n");
    ContactPair const pair = two_grains(s.grains, 0.0015);
    double const d = contact_of(s, 0.7)->overlap_of_impact(pair, 0.7), energy = pair.mass * 0.49 / 2;
    EXPECT_NEAR(8.0 / 15 * effective * std::sqrt(pair.radius) * std::pow(d, 2.5),
                energy + pi * pair.radius * 1e5 * d * d, 1e-6 * energy);
    EXPECT_GT(d, contact_of(with_engine(), 0.7)->overlap_of_impact(pair, 0.7));
    // At the speed for which it was chosen, the spring of Hooke is pressed as far as Hertz.
    EXPECT_NEAR(contact_of(with_engine("contact = \"hooke\"\n"), 0.7)->overlap_of_impact(pair, 0.7),
                contact_of(with_engine(), 0.7)->overlap_of_impact(pair, 0.7), 1e-12);
}

// k goes with E^(4/5) v^(2/5): the contact of two equal grains lasts pi (15/16)^(2/5) = 3.06 instead of 2.87
// (m*^2 / (R* E*^2 v))^(1/5) without damping, and 2 acos(z) / pi / sqrt(1 - z^2) = 0.864 of that at a
// restitution of 0.5 (z = 0.2553).
TEST(Contact, TheTimeStepOfHookeFollowsItsContactTime) {
    PreparedCase const hertz = prepare_case(with_engine()),
                       hooke = prepare_case(with_engine("contact = \"hooke\"\n"));
    double const hertz_time = hertz.time.time_step / hertz.time.contact_fraction,
                 hooke_time = hooke.time.time_step / hooke.time.contact_fraction;
    double const damped = 2 * std::acos(0.255276) / pi / std::sqrt(1 - 0.255276 * 0.255276);
    EXPECT_NEAR(hooke_time / hertz_time, pi * std::pow(15.0 / 16, 0.4) / 2.87 * damped, 1e-4);
    EXPECT_LE(hooke.time.contact_fraction, 0.1);
    EXPECT_EQ(hooke.settle_speed, std::sqrt(2 * 9.81 * hooke.fill_top));
}

}  // namespace
}  // namespace vibrotrough::prepare
