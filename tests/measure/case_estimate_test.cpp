#include "measure/case_estimate.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

constexpr Precision demanded{0.95, 0.02};

/// Packings of equal length, which start in turn below and above.
struct LayerCase {
    std::vector<std::vector<double>> runs;

    CaseEstimate estimate(Precision const& precision = demanded) const {
        std::vector<PackingValues> packings;
        for (std::size_t i = 0; i < runs.size(); ++i)
            packings.push_back({runs[i], i % 2 == 0 ? Start::below : Start::above});
        return estimate_case(packings, precision);
    }
};

/// Cycles that alternate about a mean: a deviation of `scatter` and a mean that is exact.
std::vector<double> around(double mean, double scatter, int cycles = 20) {
    std::vector<double> values;
    for (int i = 0; i < cycles; ++i) values.push_back(mean + (i % 2 == 0 ? scatter : -scatter));
    return values;
}

// The means 0.80, 0.81, 0.82, 0.81 have s = 0.008165 and hardly any fluctuations within: Student's interval
// t s / sqrt(4) at the level 1 - 0.5 x 0.05 = 0.975, t(0.9875; 3) = 4.176535 (scipy.stats.t.ppf).
TEST(CaseEstimate, IsStudentsIntervalWherePackingsDifferMoreThanCycles) {
    LayerCase const four{{around(0.80, 1e-4), around(0.81, 1e-4), around(0.82, 1e-4), around(0.81, 1e-4)}};
    CaseEstimate const estimate = four.estimate();
    EXPECT_NEAR(estimate.mean.value(), 0.81, 1e-12);
    EXPECT_NEAR(estimate.deviation.value(), std::sqrt(2e-4 / 3), 1e-9);
    EXPECT_NEAR(estimate.half_width.value(), 4.176535 * std::sqrt(2e-4 / 3) / 2, 1e-6);
    EXPECT_EQ(estimate.packings, 4);
    EXPECT_EQ(estimate.discarded, 0);
    EXPECT_EQ(estimate.measured, 20);
    EXPECT_EQ(estimate.steadiness, Steadiness::steady);
}

// Packings that agree by chance: the interval is that of the fluctuations within the runs. Alternating cycles
// count as independent (g = 1), so that w = s / sqrt(20) with s^2 = 0.01^2 x 80 / 76.
TEST(CaseEstimate, AgreementByChanceDoesNotNarrowTheInterval) {
    LayerCase const lucky{{around(0.8, 0.01), around(0.8, 0.01), around(0.8, 0.01), around(0.8, 0.01)}};
    CaseEstimate const estimate = lucky.estimate();
    double const within = 0.01 * std::sqrt(80.0 / 76 / 20);
    EXPECT_NEAR(estimate.deviation_within, within, 1e-12);
    EXPECT_NEAR(estimate.deviation.value(), within, 1e-12);
    EXPECT_GT(estimate.half_width.value(), 2.1 * within / 2) << "nearly normal: many degrees of freedom";
    EXPECT_LT(estimate.half_width.value(), 2.3 * within / 2);
}

// MSER over all packings at once: a start-up of 4 cycles that all have.
TEST(CaseEstimate, LeavesOutTheCommonStartup) {
    LayerCase started;
    for (double const mean : {0.80, 0.81, 0.82, 0.81}) {
        started.runs.push_back(around(mean, 0.005));
        for (std::size_t i = 0; i < 4; ++i) started.runs.back()[i] += i % 2 == 0 ? 0.3 : 0.2;
    }
    EXPECT_EQ(started.estimate().discarded, 4);
    EXPECT_NEAR(started.estimate().mean.value(), 0.81, 1e-12);
}

TEST(CaseEstimate, TwoBranchesAreNotSteady) {
    LayerCase const branches{{around(0.20, 0.01), around(0.25, 0.01), around(0.21, 0.01), around(0.26, 0.01),
                              around(0.205, 0.01), around(0.255, 0.01)}};
    CaseEstimate const estimate = branches.estimate();
    EXPECT_EQ(estimate.steadiness, Steadiness::branching);
    ASSERT_TRUE(estimate.below && estimate.above);
    EXPECT_NEAR(estimate.below->mean, 0.205, 1e-12);
    EXPECT_NEAR(estimate.above->mean, 0.255, 1e-12);
    EXPECT_EQ(estimate.below->packings, 3);
    EXPECT_LT(estimate.below->half_width.value(), 0.02);
    // Who asks for less than their difference is told that the case is steady.
    EXPECT_EQ(branches.estimate({0.95, 0.06}).steadiness, Steadiness::steady);
}

TEST(CaseEstimate, ACommonDriftIsNotSteady) {
    LayerCase drifting;
    for (int run = 0; run < 4; ++run) {
        drifting.runs.emplace_back();
        for (int i = 0; i < 40; ++i) drifting.runs.back().push_back(0.5 + 0.005 * i + 0.01 * run);
    }
    EXPECT_EQ(drifting.estimate().steadiness, Steadiness::drifting);
}

// What is left of a start-up that all packings share is part of the interval: the root of the sum of squares
// of Student's interval, t(0.9875; 3) s / 2 = 4.176535 x 0.008165 / 2 (the test above), and drift_left().
TEST(CaseEstimate, WhatIsLeftOfACommonStartUpWidensTheInterval) {
    LayerCase falling;
    for (double const mean : {0.80, 0.81, 0.82, 0.81}) {
        falling.runs.push_back(around(mean, 1e-4));
        for (std::size_t i = 0; i < 20; ++i)
            falling.runs.back()[i] += 0.05 * std::exp(-static_cast<double>(i) / 10);
    }
    CaseEstimate const estimate = falling.estimate();
    EXPECT_EQ(estimate.discarded, 10) << "MSER of the mean of all packings";
    EXPECT_NEAR(estimate.drift, *estimate.mean - 0.81, 1e-3 * estimate.drift) << "it is among the decays";
    EXPECT_NEAR(*estimate.half_width, std::hypot(4.176535 * std::sqrt(2e-4 / 3) / 2, estimate.drift), 1e-6);
    EXPECT_LE(std::abs(*estimate.mean - 0.81), *estimate.half_width);
    EXPECT_EQ((LayerCase{{falling.runs.front()}}.estimate().drift), 0) << "nothing to compare it with";
}

// Independent wanderers drift up and down; together they do not.
TEST(CaseEstimate, WanderingIsNoCommonDrift) {
    LayerCase wandering;
    for (double const slope : {0.005, 0.004, -0.004, -0.005, 0.003, -0.003}) {
        wandering.runs.emplace_back();
        for (int i = 0; i < 40; ++i) wandering.runs.back().push_back(0.5 + slope * (i - 20));
    }
    EXPECT_EQ(wandering.estimate().steadiness, Steadiness::steady);
}

TEST(CaseEstimate, OnePackingHasTheIntervalOfItsRun) {
    LayerCase const one{{around(0.8, 0.01)}};
    PackingEstimate const run = estimate_packing(one.runs.front(), demanded);
    EXPECT_EQ(one.estimate().mean, run.mean);
    EXPECT_EQ(one.estimate().half_width, run.half_width);
    EXPECT_FALSE(one.estimate().deviation);
}

TEST(CaseEstimate, NeedsPackingsOfEqualLength) {
    EXPECT_THROW(estimate_case({}, demanded), std::invalid_argument);
    EXPECT_THROW((LayerCase{{around(0.8, 0.01), around(0.8, 0.01, 22)}}.estimate()), std::invalid_argument);
    CaseEstimate const empty = LayerCase{{{}, {}}}.estimate();
    EXPECT_FALSE(empty.mean || empty.half_width);
    EXPECT_EQ(empty.steadiness, Steadiness::drifting);
    // Cycles that never change have an interval of zero width, not an unbounded one.
    EXPECT_EQ((LayerCase{{around(0.8, 0), around(0.8, 0)}}.estimate().half_width), 0);
}

// P packings have the half-width t(P - 1) s / sqrt(P): the number that is found is the first with at most the
// one wanted, up to rounding.
TEST(CaseEstimate, SaysHowManyPackingsAreNeeded) {
    CaseEstimate estimate;
    EXPECT_FALSE(packings_needed(estimate, demanded)) << "nothing known";
    estimate.deviation = 0.03;
    auto const needed = packings_needed(estimate, demanded);
    ASSERT_TRUE(needed);
    EXPECT_NEAR(*needed, 15, 1);  // t(0.9875; 14) = 2.51: 2.51 x 0.03 / sqrt(15) = 0.0194
    EXPECT_NEAR(*packings_needed(estimate, {0.95, 0.002}), 1133, 10);  // (2.244 x 15)^2: normal
}

// Two packings of each start: Student's t with two degrees of freedom at the level 0.99 is 9.925
// (scipy.stats.t.ppf(0.995, 2)). The means below and above scatter by 0.005 sqrt(2) each, so that the starts
// differ by 8.5 and by 11.3 standard deviations.
TEST(CaseEstimate, FewPackingsShowBranchesOnlyWhereTheyAreFarApart) {
    auto const steadiness = [](double above) {
        return LayerCase{
            {around(0.20, 1e-4), around(above, 1e-4), around(0.21, 1e-4), around(above + 0.01, 1e-4)}}
            .estimate()
            .steadiness;
    };
    EXPECT_EQ(steadiness(0.26), Steadiness::steady);
    EXPECT_EQ(steadiness(0.28), Steadiness::branching);
}

}  // namespace
}  // namespace vibrotrough::measure
