#include "inference/sampler.hpp"

#include "inference/diagnostics.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace vibrotrough::inference {
namespace {

double mean(std::vector<double> const& values) {
    double sum = 0;
    for (double const v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

/// Means of that many independent draws scatter by sigma / sqrt(ESS); five of these are a safe tolerance.
double tolerance(double sigma, double ess) {
    return 5 * sigma / std::sqrt(ess);
}

// Normal density with standard deviations 0.02 and 1 and correlation 0.95: a narrow, oblique ridge.
TEST(Sampler, NarrowCorrelatedNormal) {
    constexpr double rho = 0.95, sx = 0.02, sy = 1;
    auto const density = [](std::span<double const> p) {
        double const x = (p[0] - 0.3) / sx, y = (p[1] - 2) / sy;
        return -(x * x - 2 * rho * x * y + y * y) / (2 * (1 - rho * rho));
    };
    Sample const s = sample(density, {{-1, 1}, {-10, 10}}, {});
    ASSERT_TRUE(s.converged);
    std::vector<double> const x = s.of(0), y = s.of(1);
    EXPECT_NEAR(mean(x), 0.3, tolerance(sx, s.ess[0]));
    EXPECT_NEAR(mean(y), 2, tolerance(sy, s.ess[1]));
    // 95 % of a normal distribution lie within 1.96 standard deviations. An end of that interval scatters by
    // sqrt(0.025 * 0.975) / 0.058 / sqrt(ESS) = 2.7 / sqrt(ESS) standard deviations.
    EXPECT_NEAR((quantile(y, 0.975) - 2) / sy, 1.96, 5 * 2.7 / std::sqrt(s.ess[1]));
    EXPECT_NEAR((quantile(x, 0.025) - 0.3) / sx, -1.96, 5 * 2.7 / std::sqrt(s.ess[0]));
}

// Two separate peaks of width 0.01, 50 widths apart, the right one with three quarters of the mass. Chains of
// local steps alone would stay where they start.
TEST(Sampler, SeparatePeaksHaveTheirShares) {
    auto const density = [](std::span<double const> p) {
        double const a = (p[0] - 0.2) / 0.01, b = (p[0] - 0.7) / 0.01;
        return std::log(0.25 * std::exp(-a * a / 2) + 0.75 * std::exp(-b * b / 2) + 1e-300);
    };
    Sample const s = sample(density, {{0, 1}}, {});
    ASSERT_TRUE(s.converged);
    double right = 0;
    for (double const x : s.of(0)) right += x > 0.45 ? 1 : 0;
    right /= static_cast<double>(s.of(0).size());
    EXPECT_NEAR(right, 0.75, tolerance(std::sqrt(0.75 * 0.25), s.ess[0]));
}

// A density that is constant within the bounds has the mean and the quantiles of the uniform distribution.
TEST(Sampler, ConstantDensityFillsTheBounds) {
    Sample const s = sample([](std::span<double const>) { return 0.0; }, {{2, 6}}, {});
    ASSERT_TRUE(s.converged);
    EXPECT_NEAR(mean(s.of(0)), 4, tolerance(4 / std::sqrt(12.0), s.ess[0]));
    for (double const x : s.of(0)) {
        EXPECT_GE(x, 2);
        EXPECT_LE(x, 6);
    }
}

TEST(Sampler, TheSameSeedGivesTheSameDraws) {
    auto const density = [](std::span<double const> p) { return -p[0] * p[0]; };
    SamplerSettings settings;
    EXPECT_EQ(sample(density, {{-5, 5}}, settings).values, sample(density, {{-5, 5}}, settings).values);
    SamplerSettings other;
    other.seed = 2;
    EXPECT_NE(sample(density, {{-5, 5}}, settings).values, sample(density, {{-5, 5}}, other).values);
}

// NaN is a density of zero, so that no draw lies there.
TEST(Sampler, NanIsImpossible) {
    auto const density = [](std::span<double const> p) { return p[0] < 0 ? std::nan("") : 0.0; };
    for (double const x : sample(density, {{-1, 1}}, {}).of(0)) EXPECT_GE(x, 0);
}

// Twelve parameters, each within a hundredth of its bounds' width: among random points none is near, but
// chains that begin at the peak draw the density. Its mean square distance is 12, with
// a standard deviation of sqrt(24); tolerance: a quarter of it, five standard deviations of the mean of 70
// independent draws.
TEST(Sampler, ManyParametersNeedStartsAboutThePeak) {
    constexpr std::size_t parameters = 12;
    auto const density = [](std::span<double const> p) {
        double sum = 0;
        for (double const x : p) sum += x * x / (0.01 * 0.01);
        return -sum / 2;
    };
    SamplerSettings settings;
    settings.chains = 4;
    settings.warm_up = 400;
    settings.draws = settings.most_draws = 2000;
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal(0, 0.003);
    for (int i = 0; i < 124; ++i) {
        std::vector<double> point(parameters, 0.0);
        if (i >= settings.chains)
            for (double& x : point) x = normal(random);
        settings.starts.push_back(point);
    }
    Sample const s = sample(density, std::vector<Bounds>(parameters, {-0.5, 0.5}), settings);
    double squares = 0;
    for (double const x : s.values) squares += x * x / (0.01 * 0.01);
    EXPECT_NEAR(squares / (s.chains * s.draws), parameters, parameters / 4.0);
    settings.starts.resize(3);
    EXPECT_THROW(sample(density, std::vector<Bounds>(parameters, {-0.5, 0.5}), settings),
                 std::invalid_argument);
}

// Told while starts are tried, and then once for each step of all chains, up to the most that there can be.
TEST(Sampler, ProgressIsToldAtEveryStep) {
    SamplerSettings settings;
    settings.warm_up = 100;
    settings.draws = 50;
    settings.most_draws = 200;
    settings.least_ess = 1e6;  // never reached
    settings.points_per_start = 3;
    std::vector<int> told, expected(static_cast<std::size_t>(settings.chains * settings.points_per_start), 0);
    for (int step = 1; step <= 300; ++step) expected.push_back(step);
    settings.progress = [&](int steps, int most) {
        told.push_back(steps);
        EXPECT_EQ(most, 300);
    };
    sample([](std::span<double const>) { return 0.0; }, {{0, 1}}, settings);
    EXPECT_EQ(told, expected);
}

// Too few draws are said to be too few.
TEST(Sampler, TooFewDrawsHaveNotConverged) {
    SamplerSettings settings;
    settings.draws = settings.most_draws = 20;
    EXPECT_FALSE(sample([](std::span<double const>) { return 0.0; }, {{0, 1}}, settings).converged);
}

TEST(Sampler, SenselessInputsAreRefused) {
    auto const flat = [](std::span<double const>) { return 0.0; };
    EXPECT_THROW(sample(flat, {}, {}), std::invalid_argument);
    EXPECT_THROW(sample(flat, {{1, 1}}, {}), std::invalid_argument);
    EXPECT_THROW(sample(flat, {{0, std::numeric_limits<double>::infinity()}}, {}), std::invalid_argument);
    SamplerSettings one_chain;
    one_chain.chains = 1;
    EXPECT_THROW(sample(flat, {{0, 1}}, one_chain), std::invalid_argument);
    auto const nowhere = [](std::span<double const>) { return -std::numeric_limits<double>::infinity(); };
    EXPECT_THROW(sample(nowhere, {{0, 1}}, {}), std::invalid_argument);
}

// Chains may agree and still know a quantity too roughly: both conditions must hold.
TEST(Sampler, ChainsThatAgreeMayHaveTooFewIndependentDraws) {
    SamplerSettings settings;
    settings.most_draws = settings.draws;
    settings.least_ess = 1e6;
    Sample const s = sample([](std::span<double const>) { return 0.0; }, {{0, 1}}, settings);
    ASSERT_LE(s.rhat[0], settings.largest_rhat);
    EXPECT_FALSE(s.converged);
    settings.least_ess = 1;
    EXPECT_TRUE(sample([](std::span<double const>) { return 0.0; }, {{0, 1}}, settings).converged);
}

}  // namespace
}  // namespace vibrotrough::inference
