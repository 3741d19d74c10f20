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

// A mass that nearly comes to rest where its slide begins: a velocity of 3e-6 was taken for rest, and eta was
// off by 2e-6. Tolerance: as above.
TEST(Exactness, ASmallVelocityIsNotRest) {
    PointMass const input{0.638095966569494, 0.2188809655, -0.1033240677, 0.1088858357};
    auto const reference = static_cast<double>(reference_efficiency(input, 1, 3000));
    EXPECT_NEAR(EfficiencySolver()(input).velocity_efficiency, reference, 1e-9);
}

// Beside a change of mode (FN' to FP'N and others, over the throw number) one of the phases is as short as
// one likes; an eta that was extrapolated over the change was off by 9e-7. Tolerance: as above, and a
// reference that misses phases shorter than 1e-3 rad.
TEST(Exactness, HoldsBesideAChangeOfMode) {
    EfficiencySolver fast;
    auto const at = [](double throw_number) { return PointMass{throw_number, 0.5, -0.05, 0.3}; };
    int changes = 0;
    for (double gamma = 1.05; gamma < 3.2; gamma += 0.05) {
        double low = gamma, high = gamma + 0.05;
        ModeCode const mode = fast(at(low)).mode;
        if (fast(at(high)).mode == mode) continue;
        while (high - low > 1e-14) (fast(at((low + high) / 2)).mode == mode ? low : high) = (low + high) / 2;
        ++changes;
        for (double const beside : {-1e-6, -1e-7, 1e-7, 1e-6}) {
            PointMass const input = at(low + beside);
            auto const reference = static_cast<double>(reference_efficiency(input, 1, 400));
            EXPECT_NEAR(fast(input).velocity_efficiency, reference, 1e-9) << low << ' ' << beside;
        }
    }
    EXPECT_GE(changes, 3);
}

// The fast solver gives what solve() gives, to the last bit, over the map used for the speed benchmark.
TEST(Exactness, FastSolverAgreesOverAMap) {
    EfficiencySolver fast;
    int const n = 120;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            double const beta = (5 + 55.0 * i / (n - 1)) * std::acos(-1.0) / 180;
            PointMass const input{0.3 + 3.0 * j / (n - 1), std::tan(beta), -0.1, 0.35};
            Motion const motion = solve(input);
            Efficiency const answer = fast(input);
            ASSERT_EQ(answer.velocity_efficiency, motion.velocity_efficiency)
                << input.throw_number << ' ' << input.tan_vibration_angle;
            ASSERT_EQ(to_string(answer.mode), motion.mode)
                << input.throw_number << ' ' << input.tan_vibration_angle;
        }
    }
}

}  // namespace
}  // namespace vibrotrough::theory
