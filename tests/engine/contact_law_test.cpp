#include "engine/contact_law.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::engine {
namespace {

ContactMaterial material(double restitution, double friction) {
    return {0.0015, 1400, 5e6, 0.35, restitution, friction};
}

// In dimensionless form x'' = -max(0, x^1.5 + c x^0.25 x') with c = 2 sqrt(5/6) |b| sqrt(1.5), which depends
// on the nominal restitution alone. The numbers are from a Runge-Kutta integration of this equation in
// another language, with 5000 steps; the error of the program's first-order steps is 1e-4.
TEST(ContactLaw, RestitutionOfANormalImpact) {
    for (auto const& [nominal, realised] :
         {std::pair{0.1, 0.25273}, {0.3, 0.39714}, {0.5, 0.55029}, {0.7, 0.71820}, {0.9, 0.90203}}) {
        EXPECT_NEAR(integrate_impact(material(nominal, 0.23), 0.5, 0).normal_speed / 0.5, realised, 1e-4);
    }
}

// The contact law does not have a scale of its own: restitution is the same at every speed and size.
TEST(ContactLaw, RestitutionDoesNotDependOnSpeedOrSize) {
    double const one = integrate_impact(material(0.4, 0.23), 0.5, 0).normal_speed / 0.5;
    ContactMaterial large = material(0.4, 0.23);
    large.radius = 0.02;
    large.youngs_modulus = 1e9;
    EXPECT_NEAR(integrate_impact(large, 3, 0).normal_speed / 3, one, 1e-5);
}

// Without dissipation e = 1; the semi-implicit integration conserves energy to 1e-4.
TEST(ContactLaw, ElasticImpactKeepsItsSpeed) {
    EXPECT_NEAR(integrate_impact(material(1, 0), 0.5, 0.3).normal_speed, 0.5, 1e-4);
    EXPECT_EQ(integrate_impact(material(1, 0), 0.5, 0.3).tangential_speed, 0.3);
}

// If the contact slides throughout, friction is always mu N: m (v_t - v_t') = mu m (v_n + v_n'), and the spin
// is 5/2 of that velocity change divided by R, reduced (by less than 1 %) because the lever arm is shorter by
// half the overlap.
TEST(ContactLaw, SlidingImpactIsCoulombs) {
    auto const after = integrate_impact(material(0.9, 0.05), 0.25, 1);
    double const impulse = 1 - after.tangential_speed;
    EXPECT_NEAR(impulse / (0.05 * (0.25 + after.normal_speed)), 1, 1e-3);
    EXPECT_NEAR(after.spin * 0.0015 / (2.5 * impulse), 1, 0.015);
    EXPECT_LT(after.spin * 0.0015, 2.5 * impulse);
}

TEST(ContactLaw, NoImpactGainsEnergy) {
    for (double const nominal : {0.1, 0.5, 0.9, 1.0}) {
        for (double const friction : {0.0, 0.2, 0.5, 2.0}) {
            for (double const along : {0.0, 0.05, 0.3, 2.0}) {
                auto const after = integrate_impact(material(nominal, friction), 0.4, along);
                double const energy = std::pow(after.normal_speed, 2) + std::pow(after.tangential_speed, 2) +
                                      0.4 * std::pow(0.0015 * after.spin, 2);
                EXPECT_LE(energy, (0.16 + along * along) * (1 + 2e-4))
                    << nominal << ' ' << friction << ' ' << along;
            }
        }
    }
}

}  // namespace
}  // namespace vibrotrough::engine
