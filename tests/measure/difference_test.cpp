#include "measure/difference.hpp"

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

constexpr double confidence = 0.95;

CaseEstimate estimate_of(double mean, double deviation, int packings, double drift = 0) {
    CaseEstimate estimate;
    estimate.mean = mean;
    estimate.deviation = deviation;
    estimate.packings = packings;
    estimate.drift = drift;
    return estimate;
}

// Two equal groups of four: the standard error is sqrt(2 s^2 / 4), with 6 degrees of freedom, whose quantile
// for 97.5 % is 2.9687 (R: qt(0.9875, 6)).
TEST(Difference, IsWelchs) {
    CaseEstimate const one = estimate_of(0.8, 0.02, 4);
    double const expected = 2.9687 * 0.02 / std::sqrt(2.0);
    EXPECT_NEAR(half_width_of_difference(one, one, confidence).value(), expected, 1e-4 * expected);
    // A case that is known exactly leaves the other's interval, with its 3 degrees of freedom: 4.1765.
    CaseEstimate const exact = estimate_of(0.5, 0, 4);
    EXPECT_NEAR(half_width_of_difference(one, exact, confidence).value(), 4.1765 * 0.01, 1e-4 * 0.042);
    CaseEstimate const drifting = estimate_of(0.5, 0, 4, 0.03);
    EXPECT_NEAR(half_width_of_difference(drifting, exact, confidence).value(), 0.03, 1e-12);
}

TEST(Difference, NeedsTwoPackingsOfEach) {
    CaseEstimate const one = estimate_of(0.8, 0.02, 4);
    EXPECT_FALSE(half_width_of_difference(one, estimate_of(0.8, 0.02, 1), confidence));
    EXPECT_FALSE(half_width_of_difference(one, CaseEstimate{}, confidence));
}

using Random = std::mt19937;

/// The cycles of a packing about a mean: an offset of its own and noise.
std::vector<double> cycles_of(double mean, double scatter, Random& random) {
    constexpr int count = 40;
    std::normal_distribution<double> normal;
    double const own = mean + scatter * normal(random);
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(own + 0.03 * normal(random));
    return values;
}

CaseEstimate estimate_of(std::vector<std::vector<double>> const& runs, Precision const& wanted) {
    std::vector<PackingValues> packings;
    for (std::size_t i = 0; i < runs.size(); ++i)
        packings.push_back({runs[i], i % 2 == 0 ? Start::below : Start::above});
    return estimate_case(packings, wanted);
}

/// A made-up case, which gets packings until it is known well enough, as in a campaign: fewer than six must
/// be twice as precise, because they can agree by chance.
CaseEstimate until_precise(double mean, double scatter, Precision const& wanted, Random& random) {
    constexpr std::size_t fewest = 4, most = 24, enough_to_trust = 6;
    std::vector<std::vector<double>> runs;
    for (;;) {
        for (int i = 0; i < 2; ++i) runs.push_back(cycles_of(mean, scatter, random));
        if (runs.size() < fewest) continue;
        CaseEstimate const estimate = estimate_of(runs, wanted);
        Precision needed = wanted;
        if (runs.size() < enough_to_trust) needed.half_width /= 2;
        if (is_precise(estimate, needed) || runs.size() >= most) return estimate;
    }
}

/// How many of 95 % intervals of 2,000 random pairs with a known difference hold it.
template <typename Maker>
double coverage(Maker const& made) {
    constexpr int pairs = 2000;
    Random random(20261128);
    std::uniform_real_distribution<double> mean(0.2, 0.9), scatter(0.005, 0.03);
    int held = 0, with_interval = 0;
    for (int i = 0; i < pairs; ++i) {
        double const one = mean(random), other = mean(random);
        CaseEstimate const first = made(one, scatter(random), random),
                           second = made(other, scatter(random), random);
        auto const width = half_width_of_difference(first, second, confidence);
        if (!width) continue;
        ++with_interval;
        held += std::abs(*first.mean - *second.mean - (one - other)) <= *width ? 1 : 0;
    }
    EXPECT_EQ(with_interval, pairs);
    return static_cast<double>(held) / with_interval;
}

// How campaigns run. Three standard errors of 2,000 draws of 95 % are 1.5 %; two points are what the
// intervals may be off.
TEST(Difference, HoldsTheTruthWhenPackingsAreAddedUntilPrecise) {
    auto const added = [](double mean, double scatter, Random& random) {
        return until_precise(mean, scatter, {.confidence = confidence, .half_width = 0.02}, random);
    };
    double const held = coverage(added);
    RecordProperty("held", std::to_string(held));
    EXPECT_GE(held, 0.93);
    EXPECT_LE(held, 0.97);
}

// With a number of packings that was given, the same interval holds the truth at its own level, 97.5 %; with
// these few packings within a point and a half.
TEST(Difference, IsWiderWhereNothingIsAdded) {
    auto const fixed = [](double mean, double scatter, Random& random) {
        std::vector<std::vector<double>> runs;
        int const packings = std::uniform_int_distribution<int>(4, 10)(random);
        for (int i = 0; i < packings; ++i) runs.push_back(cycles_of(mean, scatter, random));
        return estimate_of(runs, {.confidence = confidence, .half_width = 0.03});
    };
    double const held = coverage(fixed);
    RecordProperty("held", std::to_string(held));
    EXPECT_GE(held, 0.95);
    EXPECT_LE(held, 0.99);
}

}  // namespace
}  // namespace vibrotrough::measure
