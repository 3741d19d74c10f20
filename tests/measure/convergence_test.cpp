#include "measure/convergence.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

using Means = std::vector<RefinedMean>;

/// m(h) = limit + error h^p at h = 1, 1/2, 1/4, all with one half-width.
Means means_on_a_line(double limit, double error, double order, double half_width) {
    Means means;
    for (double const h : {1.0, 0.5, 0.25})
        means.push_back({h, limit + error * std::pow(h, order), half_width});
    return means;
}

// m(h) = m_0 + b h^p exactly: the error of the default (h = 1) is b, whatever the order and the sign.
TEST(NumericalError, IsExactOnALineOfKnownOrder) {
    for (double const order : {0.4, 1.0, 2.0}) {
        for (double const error : {-0.05, 0.05}) {
            auto const found = numerical_error(means_on_a_line(0.8, error, order, 0.01), order);
            EXPECT_EQ(found.verdict, Convergence::extrapolated);
            EXPECT_NEAR(found.error, error, 1e-14);  // a sum of three numbers of order one
        }
    }
}

// The variance of a fitted slope is s^2 / sum (x - <x>)^2 with equal errors s: x = 1, 1/2, 1/4 has the mean
// 7/12 and the sum of squares 7/24.
TEST(NumericalError, HasTheIntervalOfTheFittedSlope) {
    auto const found = numerical_error(means_on_a_line(0.8, 0.05, 1, 0.01), 1);
    EXPECT_NEAR(found.half_width, 0.01 / std::sqrt(7.0 / 24), 1e-14);
}

// Two exact means of order p, Richardson's formula: m_0 = m_2 + (m_2 - m_1) / (2^p - 1). A first mean without
// weight leaves the line to the other two.
TEST(NumericalError, IsRichardsonsForTwoExactMeans) {
    Means const means{{1, 0.87, 1e-2}, {0.5, 0.83, 1e-9}, {0.25, 0.81, 1e-9}};
    double const limit = 0.81 + (0.81 - 0.83) / (std::pow(2, 1) - 1);
    auto const found = numerical_error(means, 1);
    EXPECT_EQ(found.verdict, Convergence::extrapolated);
    EXPECT_NEAR(found.error, 0.83 + (0.83 - limit) - limit, 1e-6);  // the first weighs 1e-14 of the others
}

TEST(NumericalError, OfTwoMeansIsTheirDifference) {
    auto const found = numerical_error(Means{{1, 0.83, 0.003}, {0.5, 0.80, 0.004}}, {});
    EXPECT_EQ(found.verdict, Convergence::resolved);
    EXPECT_NEAR(found.error, 0.03, 1e-15);
    EXPECT_NEAR(found.half_width, 0.005, 1e-15);  // 3-4-5 triangle
    EXPECT_NEAR(found.bound(), 0.03 + 0.84 * 0.005, 1e-15);
}

TEST(NumericalError, IsNotResolvedWithinItsInterval) {
    auto const found = numerical_error(means_on_a_line(0.8, 0.01, 1, 0.02), 1);
    EXPECT_EQ(found.verdict, Convergence::not_resolved);
    EXPECT_NEAR(found.half_width, 0.02 * std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(found.error, 0.0075, 1e-15);
}

// P(|e| < w) = Phi((w - m) / s) - Phi((-w - m) / s) = 0.95 for a normal error with mean m and s = h / 1.96.
TEST(NumericalError, IsBelowItsBoundAt95Percent) {
    auto const phi = [](double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; };
    for (double const mean : {0.0, -0.1, 0.2, 0.5, -1.0, 2.0, 10.0}) {
        double const w = NumericalError{Convergence::resolved, mean, 1}.bound(), s = 1 / 1.96;
        double const probability = phi((w - mean) / s) - phi((-w - mean) / s);
        // The larger of two simple formulae is up to 5 % too small where they meet, at 0.16: 0.94.
        EXPECT_NEAR(probability, 0.95, 0.012) << mean;
    }
}

// Two normal estimates of one number: 1/h^2 = 1/h_1^2 + 1/h_2^2, the mean weighted by 1/h_i^2.
TEST(NumericalError, IsWeightedWithWhatIsExpected) {
    NumericalError const measured{Convergence::not_resolved, 0.01, 0.03};
    auto const both = with_expected(measured, 0.04);
    EXPECT_NEAR(both.half_width, 0.03 * 0.04 / 0.05, 1e-15);
    EXPECT_NEAR(both.error, 0.01 * 16 / 25, 1e-15);
    EXPECT_EQ(with_expected(measured, std::numeric_limits<double>::infinity()).error, 0.01);
    EXPECT_EQ(with_expected(measured, 0).error, 0) << "no error is possible";
    NumericalError const surprise{Convergence::resolved, 0.051, 0.03};
    EXPECT_EQ(with_expected(surprise, 0.04).error, 0.051) << "0.051 > 0.05: the expectation is wrong";
}

TEST(NumericalError, IsNotExtrapolatedWithoutReason) {
    Means const line = means_on_a_line(0.8, 0.05, 1, 0.001);
    EXPECT_EQ(numerical_error(line, {}).verdict, Convergence::resolved) << "the order is not known";
    EXPECT_EQ(numerical_error(line, 3).verdict, Convergence::resolved) << "the order is another";
    Means const bent{{1, 0.85, 0.001}, {0.5, 0.79, 0.001}, {0.25, 0.80, 0.001}};
    EXPECT_EQ(numerical_error(bent, 1).verdict, Convergence::resolved) << "not monotonic";
    EXPECT_NEAR(numerical_error(bent, 1).error, 0.05, 1e-15);
    Means const two{line[0], line[2]};
    EXPECT_EQ(numerical_error(two, 1).verdict, Convergence::resolved) << "two means always lie on a line";
    EXPECT_THROW(numerical_error(Means{line[0]}, 1), std::invalid_argument);
}

// 95 % intervals of an error that is extrapolated contain the true one in about 95 of 100 cases. 1000 series
// with a trend of ten standard deviations; binomial scatter of the share 0.7 %, and series that miss the line
// by chance are not extrapolated: 0.92 to 0.99.
TEST(NumericalError, HasHonestIntervals) {
    std::mt19937 engine(1);
    std::normal_distribution<double> noise(0, 0.005);
    int extrapolated = 0, inside = 0;
    for (int i = 0; i < 1000; ++i) {
        Means means = means_on_a_line(0.8, 0.05, 1, 1.96 * 0.005);
        for (RefinedMean& one : means) one.mean += noise(engine);
        auto const found = numerical_error(means, 1);
        if (found.verdict != Convergence::extrapolated) continue;
        ++extrapolated;
        inside += std::abs(found.error - 0.05) <= found.half_width ? 1 : 0;
    }
    EXPECT_GT(extrapolated, 800);
    EXPECT_GT(inside, 0.92 * extrapolated);
    EXPECT_LT(inside, 0.99 * extrapolated);
}

// An error that is not there is called resolved in five of a hundred cases: that is what 95 % means.
TEST(NumericalError, InventsNone) {
    std::mt19937 engine(2);
    std::normal_distribution<double> noise(0, 0.005);
    int invented = 0;
    for (int i = 0; i < 1000; ++i) {
        Means means = means_on_a_line(0.8, 0, 1, 1.96 * 0.005);
        for (RefinedMean& one : means) one.mean += noise(engine);
        invented += numerical_error(means, 1).verdict == Convergence::not_resolved ? 0 : 1;
    }
    EXPECT_NEAR(invented, 50, 28);  // four standard deviations of a binomial count of 1000 x 0.05
}

// Exact means, as those of a rigid block may be, are no division by zero.
TEST(NumericalError, TakesExactMeans) {
    auto const found = numerical_error(means_on_a_line(0.8, 0.05, 1, 0), 1);
    EXPECT_EQ(found.verdict, Convergence::extrapolated);
    EXPECT_NEAR(found.error, 0.05, 1e-12);
}

}  // namespace
}  // namespace vibrotrough::measure
