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

constexpr Precision two_percent{0.95, 0.02};

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
    EXPECT_EQ(statistical_inefficiency(std::vector<double>(24, 0.1 / 0.34)), 1)
        << "also when their mean is rounded";
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
    struct Sample {
        double rho;
        double at_least;
    };
    // Independent cycles: 95 % minus three standard deviations. Correlated cycles: the inefficiency estimated
    // from 60 values is too low on average; 85 % is required.
    for (Sample const& c : {Sample{0.0, 0.92}, Sample{0.5, 0.88}}) {
        int covered = 0;
        for (unsigned seed = 1; seed <= 500; ++seed) {
            auto const estimate =
                estimate_packing(Series{.start = -0.5, .rho = c.rho}.make(80, seed), two_percent);
            if (std::abs(estimate.mean - 0.8) <= estimate.half_width) ++covered;
        }
        EXPECT_GE(covered / 500.0, c.at_least) << c.rho;
        EXPECT_LE(covered / 500.0, 0.99) << c.rho;
    }
}

TEST(Estimate, SaysWhenALayerIsNotSteady) {
    std::vector<double> drifting;
    for (int i = 0; i < 60; ++i) drifting.push_back(0.01 * i);
    EXPECT_EQ(estimate_packing(drifting, two_percent).verdict, Verdict::not_steady);
    // A start-up that lasts longer than half of the run.
    EXPECT_EQ(estimate_packing(Series{.start = -0.8, .decay = 60}.make(40, 1), two_percent).verdict,
              Verdict::not_steady);
    EXPECT_EQ(estimate_packing({}, two_percent).verdict, Verdict::not_steady);
    EXPECT_EQ(estimate_packing(std::vector<double>{0.8}, two_percent).verdict, Verdict::not_steady);
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
    EXPECT_EQ(estimate_packing(Series{.sigma = 0.3}.make(40, 3), two_percent).verdict, Verdict::not_precise);
    EXPECT_EQ(estimate_packing(Series{}.make(40, 3), two_percent).verdict, Verdict::precise);
    // Five equal cycles are not sufficient, however small their scatter.
    EXPECT_NE(estimate_packing(std::vector<double>(5, 0.8), two_percent).verdict, Verdict::precise);
}

TEST(Estimate, AKnownStartupIsLeftOut) {
    std::vector<double> const values{9, 9, 0.5, 0.7, 0.5, 0.7};
    auto const estimate = estimate_packing_after(2, values, two_percent);
    EXPECT_EQ(estimate.discarded, 2);
    EXPECT_EQ(estimate.measured, 4);
    EXPECT_NEAR(estimate.mean, 0.6, 1e-15);
}

}  // namespace
}  // namespace vibrotrough::measure
