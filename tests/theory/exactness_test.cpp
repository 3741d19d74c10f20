#include "reference.hpp"
#include "theory/efficiency.hpp"
#include "theory/point_mass.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

// eta against a second formulation (tests/theory/reference.cpp). Tolerance: 1e-9 as stated by the library.
// The reference bisects to 1e-18 and misses phases shorter than its step of 1e-3 rad; these occur only close
// to a change of mode and move the mass by less than the cube of the step, 1e-9.
TEST(Exactness, AgreesWithASecondFormulation) {
    std::mt19937_64 random(20261);
    std::uniform_real_distribution<> unit(0, 1);
    int compared = 0;
    EfficiencySolver fast;
    for (int i = 0; i < 60; ++i) {
        double const mu = 0.1 + 0.9 * unit(random);
        PointMass const input{0.3 + 5 * unit(random),
                              std::tan((5 + 70 * unit(random)) * std::acos(-1.0) / 180),
                              (2 * unit(random) - 1) * 0.8 * mu, mu};
        Motion const motion = solve(input);
        ASSERT_TRUE(motion.converged);
        if (motion.period_cycles > 4) continue;  // the reference would take seconds
        auto const reference = static_cast<double>(reference_efficiency(input, motion.period_cycles, 400));
        if (std::isnan(reference)) continue;  // converges too slowly for direct repetition
        ++compared;
        auto const where = testing::Message() << input.throw_number << ' ' << input.tan_vibration_angle << ' '
                                              << input.tan_inclination << ' ' << mu << ' ' << motion.mode;
        EXPECT_NEAR(motion.velocity_efficiency, reference, 1e-9) << where;
        EXPECT_NEAR(fast(input).velocity_efficiency, reference, 1e-9) << where;
    }
    EXPECT_GE(compared, 50);
}

// The fast solver against solve(), over the map used for the speed benchmark. Tolerance: 1e-9, as stated in
// efficiency.hpp.
TEST(Exactness, FastSolverAgreesOverAMap) {
    EfficiencySolver fast;
    int const n = 120;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            double const beta = (5 + 55.0 * i / (n - 1)) * std::acos(-1.0) / 180;
            PointMass const input{0.3 + 3.0 * j / (n - 1), std::tan(beta), -0.1, 0.35};
            Motion const motion = solve(input);
            Efficiency const answer = fast(input);
            ASSERT_NEAR(answer.velocity_efficiency, motion.velocity_efficiency, 1e-9)
                << input.throw_number << ' ' << input.tan_vibration_angle;
            ASSERT_EQ(to_string(answer.mode), motion.mode)
                << input.throw_number << ' ' << input.tan_vibration_angle;
        }
    }
}

}  // namespace
}  // namespace vibrotrough::theory
