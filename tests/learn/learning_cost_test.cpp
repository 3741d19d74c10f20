#include "learn/synthetic_campaign.hpp"
#include "scenario/reader/sample_cube.hpp"
#include "theory/point_mass.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <random>

#include <boost/math/distributions/normal.hpp>
#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

// What a surface costs that is known to +-0.05 over throw number 1 to 3 and rolling friction 0 to 0.3: learnt
// with the trend of the theory or the atlas, from a Sobol design without a trend, and from a regular grid
// with bilinear interpolation. The cost of a case is that of simulations: it grows as the inverse square of
// the half-width, 1 core-second at 0.02.

constexpr double goal = 0.05;
std::vector<atlas::SurfaceInput> const inputs{{"trough.throw_number", 1, 3},
                                              {"grains.rolling_friction", 0, 0.3}};

double theory_at(atlas::Place const& p) {
    return theory::solve(theory::PointMass{p[0], std::tan(std::acos(-1.0) / 6), 0, 0.23}).velocity_efficiency;
}
using LayerAt = std::function<double(atlas::Place const&)>;
double cost_of_a_case(double half_width) {
    return std::pow(0.02 / half_width, 2);
}

std::vector<atlas::Place> sobol_places(int count, unsigned seed) {
    std::vector<atlas::Place> places;
    for (auto const& row : scenario::sample_cube(scenario::SampleMethod::sobol, count, 2, seed))
        places.push_back({1 + 2 * row[0], 0.3 * row[1]});
    return places;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

/// The fewest points of a Sobol sequence, in steps of a tenth, whose surface with a constant trend is known
/// to the goal at 200 places: the median of three draws of the noise.
double sobol_cases_without_trend(LayerAt const& layer_at) {
    auto const asked = sobol_places(200, 99);
    auto const is_known = [&](int count, unsigned seed) {
        std::mt19937_64 random(seed);
        std::normal_distribution<double> normal;
        std::vector<atlas::SurfacePoint> points;
        for (atlas::Place const& p : sobol_places(count, 1))
            points.push_back({"case", p, theory_at(p), layer_at(p) + goal / 1.96 * normal(random), goal});
        atlas::Surface const surface(inputs, points, {.trend = atlas::Trend::constant});
        return std::ranges::all_of(
            asked, [&](atlas::Place const& p) { return surface.at(p, 0).half_width <= goal; });
    };
    std::vector<double> counts;
    for (unsigned const seed : {5U, 6U, 7U}) {
        int count = 50;
        while (count < 400 && !is_known(count, seed)) count += count / 10;
        counts.push_back(count);
    }
    return median(counts);
}

/// The smallest grid of n by n cases known to the goal whose bilinear interpolation has a largest half-width
/// of no more than the goal: an error that is larger in no more than 5 % of all draws of the noise, at each
/// of 400 places. The error is distributed normally; its mean is the error of interpolation, its variance
/// that of the cases times the sum of the squared weights. (A grid says nothing of its own error, so that its
/// user would have to compute at least one more grid to know this.)
int grid_cases(LayerAt const& layer_at) {
    boost::math::normal const normal;
    auto const asked = sobol_places(400, 99);
    for (int n = 3; n < 40; ++n) {
        auto const node = [&](int i, int j) { return layer_at({1 + 2.0 * i / (n - 1), 0.3 * j / (n - 1)}); };
        bool const is_known = std::ranges::all_of(asked, [&](atlas::Place const& p) {
            double const x = (p[0] - 1) / 2 * (n - 1), y = p[1] / 0.3 * (n - 1);
            int const i = std::min(static_cast<int>(x), n - 2), j = std::min(static_cast<int>(y), n - 2);
            double const u = x - i, v = y - j;
            double const found = (1 - v) * ((1 - u) * node(i, j) + u * node(i + 1, j)) +
                                 v * ((1 - u) * node(i, j + 1) + u * node(i + 1, j + 1));
            double const bias = found - layer_at(p);
            double const sd =
                goal / 1.96 * std::sqrt((u * u + (1 - u) * (1 - u)) * (v * v + (1 - v) * (1 - v)));
            return cdf(normal, (goal - bias) / sd) - cdf(normal, (-goal - bias) / sd) >= 0.95;
        });
        if (is_known) return n * n;
    }
    return 1600;
}

/// The cost of learning over those of a Sobol design and of a grid.
std::pair<double, double> shares_of_cost(std::string const& text, Layer const& layer) {
    std::vector<double> times;
    for (unsigned const seed : {21U, 22U, 23U, 24U, 25U}) {
        SyntheticCampaign campaign(text, seed, layer);
        LearnGoal const wanted{goal, 1e6, 2};
        Learner learner(campaign.plan, *campaign.maker, wanted);
        LearnStatus status{};
        EXPECT_TRUE(campaign.learn_until(learner, wanted, status));
        times.push_back(status.core_time);
    }
    LayerAt const layer_at = [&](atlas::Place const& p) { return layer(p[0], p[1], theory_at(p)); };
    double const learnt = median(times);
    double const sobol = sobol_cases_without_trend(layer_at) * cost_of_a_case(goal);
    double const grid = grid_cases(layer_at) * cost_of_a_case(goal);
    std::cout << "core-seconds: learnt " << learnt << " (" << *std::ranges::min_element(times) << " to "
              << *std::ranges::max_element(times) << "), Sobol without trend " << sobol << ", grid " << grid
              << "\n";
    return {learnt / sobol, learnt / grid};
}

// The aim is a third of the cost of either; what is measured stands in src/manual/surrogate.md. The bound
// leaves room for the noise of five draws.
TEST(LearningCost, IsFarBelowThatOfAGridAndOfADesignWithoutTheTheory) {
    auto const [of_sobol, of_grid] = shares_of_cost(campaign_of_another_kind, layer_beside_theory);
    EXPECT_LT(of_sobol, 0.4);
    EXPECT_LT(of_grid, 0.4);
}

// From the atlas, from which layers differ as is known of them; 14 and 11 % are measured.
TEST(LearningCost, IsFarBelowAThirdFromTheAtlas) {
    auto const [of_sobol, of_grid] = shares_of_cost(domain_campaign, roughened(layer_of_atlas, 1));
    EXPECT_LT(of_sobol, 0.2);
    EXPECT_LT(of_grid, 0.2);
}

}  // namespace
}  // namespace vibrotrough::learn
