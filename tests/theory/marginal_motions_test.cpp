#include "bouncing_mass.hpp"
#include "theory/efficiency.hpp"

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

/// eta = x / (2 pi n) of the periodic motion that another simulator settles to from rest, in long double.
/// Without rebounds a mass forgets its start within some cycles; it is followed for 200, and then until its
/// state recurs to 1e-8, at which its displacement per cycle is known to as much.
double followed(PointMass const& point) {
    Conveyor c{};
    c.point = point;
    BouncingMass<long double> mass(c);
    mass.follow(200);
    auto const t = mass.t, v = mass.v, moved = mass.displacement, begin = mass.elapsed();
    for (int i = 0; i < 1000; ++i) {
        mass.step();
        bool const recurs = mass.rate == 0 && std::abs(mass.t - t) < 1e-8L && std::abs(mass.v - v) < 1e-8L;
        if (recurs && mass.elapsed() - begin > 1)
            return static_cast<double>((mass.displacement - moved) / (mass.elapsed() - begin));
    }
    return NAN;
}

// Both solvers and the other simulator agree on a motion. Tolerance: see followed().
void expect_agreement(PointMass const& point) {
    EfficiencySolver solver;
    Conveyor c{};
    c.point = point;
    double const expected = followed(point);
    EXPECT_NEAR(solver(point).velocity_efficiency, expected, 1e-8) << point.throw_number;
    EXPECT_NEAR(solver.solve(c).velocity_efficiency, expected, 1e-8) << point.throw_number;
}

// A mass that slides nearly all the time, and is beside rest for a moment: |v| <= 3e-6 is not rest.
TEST(MarginalMotions, BesideRest) {
    expect_agreement({0.638095966569494, 0.2188809655, -0.1033240677, 0.1088858357});
}

// At the boundary between two modes, such as FP'N and FN', and at 1e-12 to 1e-4 of the throw number beside
// it.
TEST(MarginalMotions, BesideBoundariesOfModes) {
    std::mt19937_64 random(3);
    auto const between = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    EfficiencySolver solver;
    for (int boundaries = 0; boundaries < 40;) {
        double const mu = between(0.05, 0.85);
        PointMass point{between(0.3, 3.2), std::tan(between(5, 80) * std::numbers::pi / 180),
                        between(-0.9, 0.9) * mu, mu};
        double low = point.throw_number, high = 1.05 * low;
        auto const mode_at = [&](double throw_number) {
            point.throw_number = throw_number;
            return solver(point).mode;
        };
        ModeCode const below = mode_at(low);
        if (below == mode_at(high)) continue;
        ++boundaries;
        for (int i = 0; i < 50; ++i) {
            double const middle = (low + high) / 2;
            (mode_at(middle) == below ? low : high) = middle;
        }
        for (double const beside : {-1e-4, -1e-8, -1e-12, 0.0, 1e-12, 1e-8, 1e-4}) {
            point.throw_number = low + beside;
            expect_agreement(point);
        }
    }
}

}  // namespace
}  // namespace vibrotrough::theory
