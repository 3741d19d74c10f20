#include "atlas/surface.hpp"

#include "core/error.hpp"
#include "scenario/reader/sample_cube.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::atlas {
namespace {

std::vector<SurfaceInput> const inputs{{"trough.throw_number", 1, 3}, {"grains.rolling_friction", 0, 0.3}};

/// Like the theory's efficiency: it rises with the throw number, and steeply at a change of mode.
double theory_at(Place const& p) {
    return 0.1 + 0.2 * (p[0] - 1) + 0.25 / (1 + std::exp(-(p[0] - 1.95) / 0.03));
}

/// A layer that is faster than the theory between throw numbers 1.2 and 2.3, the more so the easier it rolls.
double layer_at(Place const& p) {
    return theory_at(p) + 0.3 * std::exp(-std::pow((p[0] - 1.75) / 0.4, 2)) * std::exp(-p[1] / 0.15);
}

std::vector<SurfacePoint> points_of(int count, unsigned seed, double half_width) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<SurfacePoint> points;
    for (auto const& row : scenario::sample_cube(scenario::SampleMethod::sobol, count, 2, seed)) {
        Place const place{1 + 2 * row[0], 0.3 * row[1]};
        double const noise = half_width / 1.96 * normal(random);
        points.push_back({"case", place, theory_at(place), layer_at(place) + noise, half_width});
    }
    return points;
}

/// How many of `held_out` lie within the surface's 95 % interval of a measurement there.
int covered(Surface const& surface, std::vector<SurfacePoint> const& held_out) {
    int inside = 0;
    for (SurfacePoint const& one : held_out) {
        SurfaceValue const value = surface.at(one.place, one.theory);
        inside += std::abs(one.efficiency - value.efficiency) <= std::hypot(value.half_width, one.half_width)
                      ? 1
                      : 0;
    }
    return inside;
}

// A range of ratios: the middle of 3 to 20 is the root of 60, and shares go on beyond both ends. Tolerance:
// rounding.
TEST(SurfaceInput, MayCountByItsLogarithm) {
    SurfaceInput const depth{"depth", 3, 20, true}, friction{"friction", 0.2, 0.6};
    EXPECT_NEAR(depth.value_at(0.5), std::sqrt(60), 1e-12);
    EXPECT_NEAR(friction.value_at(0.5), 0.4, 1e-15);
    for (double const value : {0.1, 3.0, 7.0, 20.0, 30.0}) {
        EXPECT_NEAR(depth.value_at(depth.share_of(value)), value, 1e-12);
        EXPECT_NEAR(friction.value_at(friction.share_of(value)), value, 1e-12);
    }
    EXPECT_EQ(depth.share_of(3), 0);
    EXPECT_EQ(depth.share_of(20), 1);
    EXPECT_LT(depth.share_of(2), 0);
}

// 95 % of new measurements lie within the intervals: 190 of 200 +- 2 * 3, and as they share one surface, 180
// (90 %) to 200 are accepted.
TEST(Surface, CoversHeldOutPoints) {
    Surface const surface(inputs, points_of(30, 1, 0.03));
    EXPECT_TRUE(surface.doubts().empty()) << testing::PrintToString(surface.doubts());
    EXPECT_GT(surface.quality().q2, 0.9);
    EXPECT_GE(covered(surface, points_of(200, 7, 0.03)), 180);
}

// What the surface averages over is its posterior. With d hyperparameters whose posterior is nearly normal,
// twice the distance from the largest log-likelihood follows chi-squared with d degrees of freedom: the mean
// distance is d / 2. Chains that begin at random places end far below with many inputs, 14 to 60 in the
// tables of the atlas. Tolerance: bounds cut the normal distribution, so that d / 6 to d are accepted.
TEST(Surface, DrawsAreThoseOfThePosterior) {
    constexpr int dimensions = 6;
    std::vector<SurfaceInput> const many(dimensions, {"key", 0, 1});
    std::vector<SurfacePoint> points;
    for (auto const& row : scenario::sample_cube(scenario::SampleMethod::sobol, 48, dimensions, 1)) {
        double const value = 0.3 * std::sin(4 * row[0]) + 0.2 * row[1] * row[2] + 0.05 * row[3];
        points.push_back({"case", Place(row.begin(), row.end()), 0, value, 0.01});
    }
    constexpr double longest = 50;  // not a bound of the likelihood here
    Surface const surface(many, points, SurfacePrior{.longest = std::vector(many.size(), longest)});
    inference::ProcessData const& data = surface.process().data();
    inference::TrendPrior const prior{Eigen::VectorXd{{0, 1}}, Eigen::VectorXd{{1, 1}}};
    double const largest = surface.process().log_likelihood();
    double distance = 0;
    auto const draws = surface.draws();
    for (inference::Hyperparameters const& draw : draws)
        distance += (largest - inference::GaussianProcess(data, prior, draw).log_likelihood()) /
                    static_cast<double>(draws.size());
    EXPECT_GT(distance, (dimensions + 1) / 6.0);
    EXPECT_LT(distance, dimensions + 1);
}

// Control: efficiencies in another order have nothing to do with their places.
TEST(SurfaceControl, ShuffledAnswersAreNoticed) {
    auto points = points_of(30, 1, 0.03);
    std::vector<std::size_t> order(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = (7 * i + 11) % order.size();
    auto const right = points;
    for (std::size_t i = 0; i < points.size(); ++i) points[i].efficiency = right[order[i]].efficiency;
    Surface const surface(inputs, points);
    EXPECT_LT(surface.quality().q2, 0.5);
    EXPECT_THAT(surface.doubts(), testing::Contains(testing::HasSubstr("not predicted")));
}

// Control: points that claim to be exact, but scatter by 0.05.
TEST(SurfaceControl, NoiseSetToZeroIsNoticed) {
    auto points = points_of(40, 1, 0.1);
    for (SurfacePoint& one : points) one.half_width = 0;
    Surface const surface(inputs, points);
    EXPECT_GT(surface.quality().extra_noise, 0.02);
    EXPECT_THAT(surface.doubts(), testing::Contains(testing::HasSubstr("more than their intervals say")));
    // The extra noise is kept, so that the surface is honest all the same.
    EXPECT_GE(covered(surface, points_of(200, 7, 0.1)), 176);
}

// believe() lowers the variance of the process of the largest likelihood by what variance_reduction() says.
TEST(Surface, BelievingLowersTheVarianceAsForetold) {
    Surface surface(inputs, points_of(15, 1, 0.03));
    Place const place{1.4, 0.1}, where{1.5, 0.15};
    auto const variance = [&] {
        return std::pow(
            surface.process().predict(surface.scaled(place), Eigen::VectorXd{{1, theory_at(place)}}).sd, 2);
    };
    double const before = variance();
    double const foretold =
        surface.variance_reduction(place, theory_at(place), where, theory_at(where), 0.04);
    surface.believe({"", where, theory_at(where), 0.5, 0.04});
    EXPECT_NEAR(before - variance(), foretold, 1e-9);
}

TEST(Surface, TooFewPointsAreRefused) {
    EXPECT_THROW(Surface(inputs, points_of(3, 1, 0.03)), core::InputError);
}

}  // namespace
}  // namespace vibrotrough::atlas
