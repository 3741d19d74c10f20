#include "inference/diagnostics.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace vibrotrough::inference {
namespace {

/// x_{i+1} = rho x_i + sqrt(1 - rho^2) e_i: a stationary series of variance 1 with autocorrelation rho^lag.
Chains autoregressive(double rho, int chains, int draws) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    Chains result{{}, chains};
    for (int c = 0; c < chains; ++c) {
        double x = normal(random);
        for (int i = 0; i < draws; ++i) {
            result.values.push_back(x);
            x = rho * x + std::sqrt(1 - rho * rho) * normal(random);
        }
    }
    return result;
}

void shift_chain(Chains& chains, int chain, double shift, double factor) {
    auto const length = chains.values.size() / static_cast<std::size_t>(chains.count);
    for (std::size_t i = 0; i < length; ++i) {
        double& value = chains.values[static_cast<std::size_t>(chain) * length + i];
        value = shift + factor * value;
    }
}

// ESS = N (1 - rho) / (1 + rho) of an autoregressive series in the bulk. The tails are no more correlated
// than the bulk, so that the smallest is near it from below. The estimate scatters by about 5 % here.
TEST(Diagnostics, EffectiveSampleSizeOfAnAutoregressiveSeries) {
    for (double const rho : {0.0, 0.5, 0.9}) {
        Chains const chains = autoregressive(rho, 4, 10000);
        double const exact = 40000 * (1 - rho) / (1 + rho);
        double const found = effective_sample_size(chains);
        EXPECT_NEAR(found / exact, 1, 0.15) << rho;
    }
}

TEST(Diagnostics, RhatOfChainsThatAgreeIsOne) {
    EXPECT_NEAR(rank_normalised_rhat(autoregressive(0, 4, 2000)), 1, 0.003);
}

// Two of four chains are off by one standard deviation: between-chain variance 1/3 of the within-chain one,
// so that R-hat is about sqrt(4/3) = 1.15.
TEST(Diagnostics, RhatShowsChainsAtDifferentPlaces) {
    Chains chains = autoregressive(0, 4, 2000);
    shift_chain(chains, 0, 1, 1);
    shift_chain(chains, 1, 1, 1);
    EXPECT_NEAR(rank_normalised_rhat(chains), 1.15, 0.03);
}

// The means agree, so that only the distances to the median tell the chains apart.
TEST(Diagnostics, RhatShowsChainsOfDifferentWidth) {
    Chains chains = autoregressive(0, 4, 2000);
    shift_chain(chains, 0, 0, 3);
    EXPECT_GT(rank_normalised_rhat(chains), 1.05);
}

// Ranks do not change when all values are transformed by a monotone function, so neither does R-hat's bulk
// part; a heavy tail (Cauchy) does not spoil it.
TEST(Diagnostics, HeavyTailsDoNotSpoilIt) {
    Chains chains = autoregressive(0, 4, 2000);
    for (double& v : chains.values) v = std::tan(1.5 * std::tanh(v));
    EXPECT_NEAR(rank_normalised_rhat(chains), 1, 0.003);
}

TEST(Diagnostics, ShortChainsAreRefused) {
    EXPECT_THROW(rank_normalised_rhat({{1, 2, 3, 4, 5, 6, 7}, 1}), std::invalid_argument);
    EXPECT_THROW(effective_sample_size({{1, 2, 3, 4, 5, 6, 7, 8}, 2}), std::invalid_argument);
}

// Type 7 of Hyndman and Fan: position p (n - 1) between the sorted values.
TEST(Diagnostics, Quantile) {
    EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0), 1);
    EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1), 4);
    EXPECT_DOUBLE_EQ(quantile({10, 0}, 0.25), 2.5);
}

// The variance between the halves is compared with the variance within them as it would be of all values,
// which divides by n and not by n - 1. Where the means of both halves agree exactly, that of the values and
// that of their distances to the median, R-hat is sqrt((n - 1) / n), with n = 4 values in each half.
TEST(Diagnostics, RhatOfHalvesWithTheSameMeanIsBelowOne) {
    EXPECT_NEAR(rank_normalised_rhat({{1, 4, 5, 8, 2, 3, 6, 7}, 1}), std::sqrt(3.0 / 4), 1e-12);
}

}  // namespace
}  // namespace vibrotrough::inference
