#include "inference/gaussian_process.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace vibrotrough::inference {
namespace {

/// Values of exp(sin 3 x) with some noise at equally spaced inputs, and a constant trend.
ProcessData wave(Eigen::Index count, double noise) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    ProcessData data{Eigen::VectorXd::LinSpaced(count, 0, 1), Eigen::MatrixXd::Ones(count, 1),
                     Eigen::VectorXd(count), Eigen::VectorXd::Constant(count, noise)};
    for (Eigen::Index i = 0; i < count; ++i)
        data.values(i) = std::exp(std::sin(3 * data.inputs(i, 0))) + noise * normal(random);
    return data;
}

TrendPrior const constant{Eigen::VectorXd{{0}}, Eigen::VectorXd{{1}}};
Eigen::VectorXd const one{{1}};

Eigen::VectorXd at(double x) {
    return Eigen::VectorXd{{x}};
}

// Without noise the process goes through the data: the variance there is zero.
TEST(GaussianProcess, GoesThroughDataWithoutNoise) {
    ProcessData const data = wave(8, 0);
    GaussianProcess const process(data, constant, {0.5, at(0.4)});
    for (Eigen::Index i = 0; i < 8; ++i) {
        ProcessValue const v = process.predict(at(data.inputs(i, 0)), one);
        EXPECT_NEAR(v.mean, data.values(i), 1e-9);
        EXPECT_NEAR(v.sd, 0, 1e-6);
    }
}

// Far from the data nothing is known but the trend: the variance is that of the process and of the trend.
TEST(GaussianProcess, FarAwayOnlyTheTrendIsKnown) {
    GaussianProcess const process(wave(8, 0.01), constant, {0.5, at(0.1)});
    ProcessValue const v = process.predict(at(50), one);
    EXPECT_GT(v.sd, 0.5);
    EXPECT_LT(v.sd, std::hypot(0.5, 1));
}

// The derivative is that of central differences of the likelihood, whose error is of the order step^2.
TEST(GaussianProcess, GradientOfTheLikelihood) {
    ProcessData const data = wave(12, 0.05);
    auto const likelihood = [&](double deviation, double length, double extra) {
        return GaussianProcess(data, constant, {std::exp(deviation), at(std::exp(length)), std::exp(extra)})
            .log_likelihood();
    };
    double const d = std::log(0.4), l = std::log(0.3), e = std::log(0.03), step = 1e-5;
    Eigen::VectorXd const g = GaussianProcess(data, constant, {0.4, at(0.3), 0.03}).log_likelihood_gradient();
    EXPECT_NEAR(g(0), (likelihood(d + step, l, e) - likelihood(d - step, l, e)) / (2 * step), 1e-5);
    EXPECT_NEAR(g(1), (likelihood(d, l + step, e) - likelihood(d, l - step, e)) / (2 * step), 1e-5);
    EXPECT_NEAR(g(2), (likelihood(d, l, e + step) - likelihood(d, l, e - step)) / (2 * step), 1e-5);
}

// Leaving a value out by formula and by conditioning on the others is the same.
TEST(GaussianProcess, LeaveOneOut) {
    ProcessData const data = wave(9, 0.05);
    Hyperparameters const h{0.5, at(0.3)};
    auto const left_out = GaussianProcess(data, constant, h).leave_one_out();
    ProcessData less{data.inputs.bottomRows(8), data.trend.bottomRows(8), data.values.tail(8),
                     data.noise.tail(8)};
    ProcessValue const v = GaussianProcess(less, constant, h).predict(data.inputs.row(0), one);
    EXPECT_NEAR(left_out[0].mean, v.mean, 1e-9);
    EXPECT_NEAR(left_out[0].sd, std::hypot(v.sd, 0.05), 1e-9);
}

// cov(x, x) is the variance; and a new value at b with noise s lowers the variance at a by cov(a, b)^2 /
// (var(b) + s^2).
TEST(GaussianProcess, CovarianceTellsWhatAValueWouldTeach) {
    ProcessData const data = wave(6, 0.05);
    Hyperparameters const h{0.5, at(0.3)};
    GaussianProcess const before(data, constant, h);
    EXPECT_NEAR(before.covariance(at(0.33), one, at(0.33), one),
                std::pow(before.predict(at(0.33), one).sd, 2), 1e-12);
    ProcessData more{Eigen::MatrixXd(7, 1), Eigen::MatrixXd::Ones(7, 1), Eigen::VectorXd(7),
                     Eigen::VectorXd(7)};
    more.inputs << data.inputs, 0.7;
    more.values << data.values, 2;
    more.noise << data.noise, 0.1;
    double const covariance = before.covariance(at(0.6), one, at(0.7), one);
    double const expected = std::pow(before.predict(at(0.6), one).sd, 2) -
                            covariance * covariance / (std::pow(before.predict(at(0.7), one).sd, 2) + 0.01);
    EXPECT_NEAR(std::pow(GaussianProcess(more, constant, h).predict(at(0.6), one).sd, 2), expected, 1e-12);
}

// A process drawn from known hyperparameters gives them back: with 60 points over six lengths, log(deviation)
// and log(length) scatter by about 0.3.
TEST(GaussianProcess, FindsItsHyperparameters) {
    Eigen::Index const count = 60;
    ProcessData data{Eigen::VectorXd::LinSpaced(count, 0, 3), Eigen::MatrixXd::Ones(count, 1),
                     Eigen::VectorXd(count), Eigen::VectorXd::Constant(count, 0.01)};
    Eigen::MatrixXd covariance(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        for (Eigen::Index j = 0; j < count; ++j) {
            double const a = std::sqrt(3.0) * std::abs(data.inputs(i, 0) - data.inputs(j, 0)) / 0.5;
            covariance(i, j) = 0.09 * (1 + a) * std::exp(-a) + (i == j ? 1e-4 : 0);
        }
    }
    std::mt19937_64 random(8);
    std::normal_distribution<double> normal;
    Eigen::VectorXd white(count);
    for (double& w : white) w = normal(random);
    data.values = covariance.llt().matrixL() * white;
    Hyperparameters const h = GaussianProcess::fitted(data, constant, {}).hyperparameters();
    EXPECT_NEAR(std::log(h.deviation), std::log(0.3), 0.9);
    EXPECT_NEAR(std::log(h.lengths(0)), std::log(0.5), 0.9);
}

// log p = -sum (ln(x / median) / log_sd)^2 / 2, and its derivatives by ln x are those of central differences,
// whose error is of the order step^2.
TEST(HyperparameterPrior, IsNormalInTheLogarithms) {
    HyperparameterPrior const known{LogNormal{0.2, 0.5}, {LogNormal{0.4, 0.25}}};
    EXPECT_EQ(known.log_density({0.2, at(0.4)}), 0);
    EXPECT_NEAR(known.log_density({0.2 * std::exp(0.5), at(0.4)}), -0.5, 1e-12);
    EXPECT_NEAR(known.log_density({0.2, at(0.4 * std::exp(-0.5))}), -2, 1e-12);
    EXPECT_EQ(HyperparameterPrior{}.log_density({0.2, at(0.4)}), 0);
    double const step = 1e-5, up = std::exp(step), down = std::exp(-step);
    Eigen::VectorXd const g = known.gradient({0.3, at(0.3)});
    EXPECT_NEAR(
        g(0),
        (known.log_density({0.3 * up, at(0.3)}) - known.log_density({0.3 * down, at(0.3)})) / (2 * step),
        1e-5);
    EXPECT_NEAR(
        g(1),
        (known.log_density({0.3, at(0.3 * up)}) - known.log_density({0.3, at(0.3 * down)})) / (2 * step),
        1e-5);
    EXPECT_EQ(g(2), 0);  // nothing is known of the extra noise
    EXPECT_EQ((HyperparameterPrior{{}, {std::nullopt}}.log_density({0.3, at(0.3)})), 0);
    for (HyperparameterPrior const& wrong :
         {HyperparameterPrior{LogNormal{0, 1}}, HyperparameterPrior{LogNormal{1, 0}},
          HyperparameterPrior{{}, {LogNormal{-1, 1}}},
          HyperparameterPrior{{}, {LogNormal{1, 1}, LogNormal{1, 1}}}}) {
        ProcessSettings settings;
        settings.prior = wrong;
        EXPECT_THROW(GaussianProcess::fitted(wave(4, 0.1), constant, settings), std::invalid_argument);
    }
}

// Two values say little of the hyperparameters: what is known of them decides. Many values overrule it: they
// differ by 0.6 and more, not by 0.03.
TEST(GaussianProcess, WhatIsKnownOfHyperparametersCountsUntilTheDataSayMore) {
    ProcessSettings settings;
    settings.prior = {LogNormal{0.03, 0.1}, {LogNormal{3, 0.1}}};
    ProcessData two = wave(2, 0.5);
    two.values = Eigen::Vector2d(0.01, -0.01);
    auto const vague = GaussianProcess::fitted(two, constant, settings).hyperparameters();
    EXPECT_NEAR(vague.deviation, 0.03, 0.001);
    EXPECT_NEAR(vague.lengths(0), 3, 0.1);
    settings.prior = {LogNormal{0.03, 0.5}, {LogNormal{3, 0.5}}};
    auto const told = GaussianProcess::fitted(wave(40, 0.01), constant, settings).hyperparameters();
    EXPECT_GT(told.deviation, 0.3);
}

// Noise that the data do not admit to is found as extra noise.
TEST(GaussianProcess, FindsExtraNoise) {
    ProcessData data = wave(40, 0.1);
    data.noise.setConstant(0.01);
    ProcessSettings settings;
    settings.has_extra_noise = true;
    double const found = GaussianProcess::fitted(data, constant, settings).hyperparameters().extra_noise;
    EXPECT_NEAR(found, 0.1, 0.04);  // 40 values know a standard deviation to 12 %; three times that
}

TEST(GaussianProcess, SenselessInputsAreRefused) {
    ProcessData data = wave(4, 0);
    EXPECT_THROW(GaussianProcess(data, constant, {0, at(1)}), std::invalid_argument);
    EXPECT_THROW(GaussianProcess(data, constant, {1, at(-1)}), std::invalid_argument);
    EXPECT_THROW(GaussianProcess(data, constant, {1, Eigen::VectorXd{{1, 1}}}), std::invalid_argument);
    data.inputs(1, 0) = data.inputs(0, 0);  // two values without noise at one place
    EXPECT_THROW(GaussianProcess(data, constant, {1, at(1)}), std::invalid_argument);
    data = wave(4, 0.1);
    data.values(2) = std::nan("");
    EXPECT_THROW(GaussianProcess(data, constant, {1, at(1)}), std::invalid_argument);
    data = wave(4, 0.1);
    data.noise.resize(3);
    EXPECT_THROW(GaussianProcess(data, constant, {1, at(1)}), std::invalid_argument);
}

// Two normal distributions with means 1 and 3: the variance is the mean of theirs, 0.25 and 4, and 1 of the
// means.
TEST(GaussianProcess, MixtureHasTheMomentsOfItsParts) {
    ProcessValue const both = mixture({{1, 0.5}, {3, 2}});
    EXPECT_DOUBLE_EQ(both.mean, 2);
    EXPECT_DOUBLE_EQ(both.sd, std::sqrt((0.25 + 4) / 2 + 1));
}

}  // namespace
}  // namespace vibrotrough::inference
