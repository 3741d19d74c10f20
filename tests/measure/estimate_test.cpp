#include "measure/estimate.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

/// y_i = mean + start * exp(-i / decay) + AR(1) noise with correlation rho and standard deviation sigma.
struct Series {
    double mean = 0.8, start = 0, decay = 3, rho = 0, sigma = 0.02;

    std::vector<double> make(int n, unsigned seed) const {
        std::mt19937 engine(seed);
        std::normal_distribution<double> normal;
        std::vector<double> values;
        double noise = sigma * normal(engine);
        for (int i = 0; i < n; ++i) {
            values.push_back(mean + start * std::exp(-i / decay) + noise);
            noise = rho * noise + sigma * std::sqrt(1 - rho * rho) * normal(engine);
        }
        return values;
    }
};

constexpr Precision wanted{0.95, 0.02};

// eta_k = (x_k - x_(k-1)) / (2 pi r cos(beta)): one unit of r cos(beta) per radian.
TEST(Estimate, VelocityEfficiencyIsDisplacementPerCycle) {
    CycleSeries series;
    double const two_pi = 2 * std::acos(-1.0);
    series.x = {0.1, 0.1 + two_pi * 0.005, 0.1 + two_pi * 0.0025};
    auto const eta = velocity_efficiency(series, 0.005);
    ASSERT_EQ(eta.size(), 2u);
    EXPECT_NEAR(eta[0], 1, 1e-12);  // differences of numbers near 0.1: 1e-16 / 0.005
    EXPECT_NEAR(eta[1], -0.5, 1e-12);
    EXPECT_THROW(velocity_efficiency(series, 0), std::invalid_argument);
}

TEST(Estimate, StartupIsCutWhereItEnds) {
    // A start-up of size 0.6 that decays with a constant of 3 cycles is below the noise of 0.02 after 3
    // ln(30) = 10 cycles.
    for (unsigned seed = 1; seed <= 20; ++seed) {
        int const cut = startup_length(Series{.start = -0.6}.make(60, seed));
        EXPECT_GE(cut, 5) << seed;
        EXPECT_LE(cut, 25) << seed;
    }
    EXPECT_EQ(startup_length({}), 0);
    EXPECT_EQ(startup_length(std::vector<double>{1}), 0);
    // MSER by hand: {9, 0, 0, 0}: d = 0 gives 60.75 / 16, d = 1 gives 0.
    EXPECT_EQ(startup_length(std::vector<double>{9, 0, 0, 0}), 1);
}

// AR(1): g = (1 + rho) / (1 - rho).
TEST(Estimate, StatisticalInefficiencyOfAKnownProcess) {
    for (double const rho : {0.0, 0.5, 0.8}) {
        double const expected = (1 + rho) / (1 - rho);
        double const found = statistical_inefficiency(Series{.rho = rho}.make(20000, 7));
        // The scatter of the estimator at n = 20000 is below 10 %; Geyer's cut-off adds a bias of a few
        // percent.
        EXPECT_NEAR(found, expected, 0.15 * expected) << rho;
    }
    EXPECT_EQ(statistical_inefficiency(std::vector<double>(30, 0.5)), 1);
    // Short series: without the correction of the bias, 20 values with rho = 0.8 give g = 3 instead of 9.
    double mean = 0;
    for (unsigned seed = 1; seed <= 100; ++seed)
        mean += statistical_inefficiency(Series{.rho = 0.8}.make(20, seed)) / 100;
    EXPECT_GT(mean, 4.5);
    // Alternating cycles give a more accurate mean than independent ones; this is deliberately not used.
    std::vector<double> alternating;
    for (int i = 0; i < 40; ++i) alternating.push_back(i % 2);
    EXPECT_EQ(statistical_inefficiency(alternating), 1);
}

// A 95 % interval contains the true mean in 95 % of all series. For 500 series the standard deviation of this
// fraction is 1 %.
TEST(Estimate, IntervalCoversTheTruth) {
    struct Case {
        double rho;
        double at_least;
    };
    // Independent cycles: 95 % minus three standard deviations. Correlated cycles: the inefficiency estimated
    // from 60 values is too low on average; 85 % is required.
    for (Case const& c : {Case{0.0, 0.92}, Case{0.5, 0.88}}) {
        int covered = 0;
        for (unsigned seed = 1; seed <= 500; ++seed) {
            auto const estimate =
                estimate_packing(Series{.start = -0.5, .rho = c.rho}.make(80, seed), wanted);
            if (std::abs(estimate.mean - 0.8) <= estimate.half_width) ++covered;
        }
        EXPECT_GE(covered / 500.0, c.at_least) << c.rho;
        EXPECT_LE(covered / 500.0, 0.99) << c.rho;
    }
}

TEST(Estimate, SaysWhenALayerIsNotSteady) {
    std::vector<double> drifting;
    for (int i = 0; i < 60; ++i) drifting.push_back(0.01 * i);
    EXPECT_EQ(estimate_packing(drifting, wanted).verdict, Verdict::not_steady);
    // A start-up that lasts longer than half of the run.
    EXPECT_EQ(estimate_packing(Series{.start = -0.8, .decay = 60}.make(40, 1), wanted).verdict,
              Verdict::not_steady);
    EXPECT_EQ(estimate_packing({}, wanted).verdict, Verdict::not_steady);
    EXPECT_EQ(estimate_packing(std::vector<double>{0.8}, wanted).verdict, Verdict::not_steady);
}

// A layer may fluctuate slowly forever; if it does so by less than the required half-width, it counts as
// steady.
TEST(Estimate, WanderingWithinWhatWasAskedIsSteady) {
    std::vector<double> values = Series{.sigma = 0.001}.make(40, 1);
    for (std::size_t i = 0; i < 20; ++i) values[i] += 0.015;
    EXPECT_EQ(startup_length(values), 20);
    EXPECT_EQ(estimate_packing(values, {0.95, 0.03}).verdict, Verdict::precise);
    EXPECT_EQ(estimate_packing(values, {0.95, 0.01}).verdict, Verdict::not_steady);
}

TEST(Estimate, SaysWhenAMeanIsNotPrecise) {
    EXPECT_EQ(estimate_packing(Series{.sigma = 0.3}.make(40, 3), wanted).verdict, Verdict::not_precise);
    EXPECT_EQ(estimate_packing(Series{}.make(40, 3), wanted).verdict, Verdict::precise);
    // Five equal cycles are not sufficient, however small their scatter.
    EXPECT_NE(estimate_packing(std::vector<double>(5, 0.8), wanted).verdict, Verdict::precise);
}

TEST(Estimate, EndsAtTheFirstCheckpointWhoeverLooks) {
    auto const values = Series{.start = -0.6, .sigma = 0.04}.make(200, 5);
    auto const needed = cycles_needed(values, wanted);
    ASSERT_TRUE(needed);
    EXPECT_EQ(*needed % 5, 0);
    EXPECT_GE(*needed, 20);
    for (std::size_t seen = 0; seen <= values.size(); ++seen) {
        auto const early = cycles_needed(std::span(values).first(seen), wanted);
        if (seen < static_cast<std::size_t>(*needed)) {
            EXPECT_FALSE(early) << seen;
        } else {
            EXPECT_EQ(early, needed) << seen;
        }
    }
    auto const answer = estimate_sequentially(values, wanted);
    EXPECT_EQ(answer.used, *needed);
    EXPECT_EQ(answer.estimate.discarded + answer.estimate.measured, *needed);
}

// The result of a case has the interval over packings. Each run ends according to its own interval, which is
// too narrow if cycles are strongly correlated; the scatter between packings is not. The combined interval
// contains the true mean in 98 % or more of 1000 trials; 95 % is required.
TEST(Estimate, IntervalOverPackingsCoversTheTruthAlsoWhenCyclesWander) {
    for (double const rho : {0.0, 0.5, 0.8, 0.9}) {
        int covered = 0;
        for (unsigned trial = 0; trial < 200; ++trial) {
            std::vector<PackingEstimate> packings;
            for (unsigned packing = 1; packing <= 3; ++packing) {
                auto const values =
                    Series{.start = -0.5, .rho = rho, .sigma = 0.03}.make(200, 3 * trial + packing);
                packings.push_back(estimate_sequentially(values, {0.95, 0.03}).estimate);
            }
            auto const combined = combine(packings, 0.95);
            if (std::abs(combined.mean.value() - 0.8) <= combined.half_width.value()) ++covered;
        }
        EXPECT_GE(covered / 200.0, 0.95) << rho;
    }
}

PackingEstimate packing(double mean, double half_width) {
    return {mean, half_width, 8, 20, 1, Verdict::precise};
}

// t(0.975; 2) = 4.302653 (any table): half-width = t s / sqrt(3), s = 0.01 for 0.80, 0.81, 0.82.
TEST(Estimate, CombinesPackingsByTheirScatter) {
    std::vector const three{packing(0.80, 0.003), packing(0.81, 0.004), packing(0.82, 0.003)};
    auto const combined = combine(three, 0.95);
    EXPECT_NEAR(combined.mean.value(), 0.81, 1e-12);
    EXPECT_NEAR(combined.half_width.value(), 4.302653 * 0.01 / std::sqrt(3.0),
                1e-8);  // the table has 7 digits
    EXPECT_EQ(combined.packings, 3);
}

TEST(Estimate, AgreementByLuckDoesNotNarrowTheInterval) {
    std::vector const lucky{packing(0.8, 0.02), packing(0.8, 0.03), packing(0.8, 0.01)};
    EXPECT_EQ(combine(lucky, 0.95).half_width, 0.03);
    std::vector const one{packing(0.8, 0.02)};
    EXPECT_EQ(combine(one, 0.95).half_width, 0.02);
    EXPECT_THROW(combine({}, 0.95), std::invalid_argument);
}

TEST(Estimate, AnUnboundedIntervalHasNoHalfWidth) {
    double const unbounded = std::numeric_limits<double>::infinity();
    std::vector const some{packing(0.8, 0.02), packing(0.7, unbounded)};
    EXPECT_NEAR(combine(some, 0.95).mean.value(), 0.75, 1e-12);
    EXPECT_FALSE(combine(some, 0.95).half_width);
    std::vector const empty{packing(std::numeric_limits<double>::quiet_NaN(), unbounded)};
    EXPECT_FALSE(combine(empty, 0.95).mean);
}

}  // namespace
}  // namespace vibrotrough::measure
