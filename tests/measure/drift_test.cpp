#include "measure/drift.hpp"

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

/// What is left of f(i), added to runs that differ by their offsets and by noise.
double left_of(std::function<double(int)> const& f, int cycles, int discarded, double noise = 0,
               unsigned seed = 1, int count = 6) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<std::vector<double>> values;
    for (int run = 0; run < count; ++run) {
        values.emplace_back();
        double const offset = 0.02 * run;
        for (int i = 0; i < cycles; ++i) values.back().push_back(f(i) + offset + noise * normal(random));
    }
    std::vector<std::span<double const>> const runs(values.begin(), values.end());
    return drift_left(runs, discarded);
}

// An exponential of the family leaves the mean of f over the cycles kept, in every run alike; less than a
// thousandth is missing because the fall within the cycles kept counts as noise of the runs. Other
// decays than it do not agree, but for c / i, which always counts: at most what c / i fits to it.
TEST(DriftLeft, IsAtLeastTheMeanOfTheDecayOverTheCyclesKept) {
    for (double const size : {0.1, -0.1}) {
        for (double const part : {1.0, 2.0, 4.0, 8.0}) {
            auto const f = [&](int i) { return size * std::exp(-i * part / 64); };
            double exact = 0;
            for (int i = 32; i < 64; ++i) exact += std::abs(f(i)) / 32;
            EXPECT_GE(left_of(f, 64, 32), 0.999 * exact) << part;
            if (part < 8) {
                EXPECT_LE(left_of(f, 64, 32), 2.5 * exact) << part;
            }
        }
    }
}

// c / (i + 1/2) leaves c sum 1 / (i + 1/2) / 32, and exponentials disagree with it.
TEST(DriftLeft, KnowsTheDecayThatLayersShow) {
    double exact = 0;
    for (int i = 32; i < 64; ++i) exact += 0.3 / (i + 0.5) / 32;
    EXPECT_NEAR(left_of([](int i) { return 0.3 / (i + 0.5); }, 64, 32), exact, 1e-3 * exact);
}

TEST(DriftLeft, IsNothingWithoutADriftOrWithoutComparison) {
    EXPECT_EQ(left_of([](int) { return 0.5; }, 64, 0), 0);
    auto const decay = [](int i) { return std::exp(-i / 8.0); };
    EXPECT_EQ(left_of(decay, 64, 32, 0, 1, 1), 0) << "a single run";
    EXPECT_EQ(left_of(decay, 7, 3), 0) << "too short";
}

// Noise counts rarely: B^2 > 2 s^2 holds by chance in about a quarter of the sets for one decay and six runs
// (t with five degrees of freedom beyond 1.41: 0.22), and for one of five decays in less than half.
TEST(DriftLeft, CountsNoiseRarely) {
    int counted = 0;
    for (unsigned seed = 1; seed <= 200; ++seed)
        counted += left_of([](int) { return 0.5; }, 24, 0, 0.05, seed) > 0 ? 1 : 0;
    EXPECT_GT(counted, 200 * 0.1);
    EXPECT_LT(counted, 200 * 0.5);
}

}  // namespace
}  // namespace vibrotrough::measure
