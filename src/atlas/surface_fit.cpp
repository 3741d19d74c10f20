#include "atlas/surface.hpp"
#include "core/error.hpp"
#include "inference/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>

#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

namespace vibrotrough::atlas {
namespace {

/// Below this probability extra noise is taken to be real.
constexpr double significant = 0.01;
/// Hyperparameters are equally likely in their logarithm within these bounds; lengths over the scaled inputs.
constexpr inference::Bounds extra_noise_prior{1e-3, 1};
constexpr double largest_deviation = 1;
constexpr double shortest_length = 0.05;
/// Every 25th draw of the posterior is used: 24 of four chains.
constexpr int thinning = 25;
constexpr int chains = 4;

inference::Bounds logs_of(inference::Bounds const& b) {
    return {std::log(b.low), std::log(b.high)};
}

Eigen::VectorXd longest_lengths(SurfacePrior const& prior, Eigen::Index inputs) {
    if (prior.longest.empty()) return Eigen::VectorXd::Constant(inputs, usual_longest_length);
    return Eigen::VectorXd::Map(prior.longest.data(), inputs);
}

/// Points about the largest likelihood, in logarithms and within the bounds: that one for each chain, and
/// others about it, as many as differential evolution needs (ten for each parameter).
std::vector<std::vector<double>> starts_about(inference::Hyperparameters const& best,
                                              std::vector<inference::Bounds> const& bounds) {
    constexpr double spread = 0.15, room = 1e-3;  // in logarithms
    std::vector<double> middle{std::log(best.deviation)};
    for (double const length : best.lengths) middle.push_back(std::log(length));
    if (best.extra_noise > 0) middle.push_back(std::log(best.extra_noise));
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal(0, spread);
    std::vector<std::vector<double>> starts;
    for (std::size_t i = 0; i < chains + 10 * bounds.size(); ++i) {
        std::vector<double> point;
        for (std::size_t p = 0; p < bounds.size(); ++p) {
            auto const [low, high] = bounds[p];
            double value = std::clamp(middle[p], low + room, high - room) + (i < chains ? 0 : normal(random));
            // Reflected at the bounds: what lay on one of them would never leave it.
            if (value > high) value = 2 * high - value;
            if (value < low) value = 2 * low - value;
            point.push_back(value);
        }
        starts.push_back(std::move(point));
    }
    return starts;
}

}  // namespace

Surface::Surface(std::vector<SurfaceInput> inputs, std::vector<SurfacePoint> points,
                 SurfacePrior const& prior)
    : inputs_(std::move(inputs)), points_(std::move(points)), prior_(prior), process_(fit()) {
    draw_others();
}

inference::GaussianProcess Surface::fit() {
    auto const n = static_cast<Eigen::Index>(points_.size());
    auto const d = static_cast<Eigen::Index>(inputs_.size());
    if (n < std::max<Eigen::Index>(4, 2 * d)) {
        throw core::InputError(
            fmt::format("a surface over {} input{} needs at least {} steady cases with an interval, and "
                        "there {} {}; simulate more",
                        d, d == 1 ? "" : "s", std::max<Eigen::Index>(4, 2 * d), n == 1 ? "is" : "are", n));
    }
    inference::ProcessData const known = data();
    inference::ProcessSettings settings;
    settings.prior = prior_.about_trend;
    if (prior_.least_deviation > SurfacePrior{}.least_deviation)
        settings.least.deviation = prior_.least_deviation;
    if (!prior_.longest.empty()) settings.most.lengths = longest_lengths(prior_, d);
    auto process = inference::GaussianProcess::fitted(known, trend_prior(), settings);
    settings.has_extra_noise = true;
    auto const noisy = inference::GaussianProcess::fitted(known, trend_prior(), settings);
    // Extra noise cannot be negative, so that half of the likelihood ratio's distribution lies at zero (H.
    // Chernoff, Ann. Math. Stat. 25 (1954) 573-578).
    auto const with_prior = [&](inference::GaussianProcess const& one) {
        return one.log_likelihood() + settings.prior.log_density(one.hyperparameters());
    };
    double const ratio = std::max(0.0, 2 * (with_prior(noisy) - with_prior(process)));
    double const p = 0.5 * boost::math::cdf(boost::math::complement(boost::math::chi_squared(1), ratio));
    if (p < significant) process = noisy;
    extra_noise_p_ = p;
    return process;
}

void Surface::draw_others() {
    Eigen::Index const d = process_.data().inputs.cols();
    bool const is_noisy = process_.hyperparameters().extra_noise > 0;
    auto const from_logs = [&](std::span<double const> logs) {
        inference::Hyperparameters h{std::exp(logs[0]), Eigen::VectorXd(d),
                                     is_noisy ? std::exp(logs.back()) : 0};
        for (Eigen::Index j = 0; j < d; ++j) h.lengths(j) = std::exp(logs[static_cast<std::size_t>(1 + j)]);
        return h;
    };
    auto const density = [&](std::span<double const> logs) {
        try {
            auto const hyperparameters = from_logs(logs);
            return inference::GaussianProcess(process_.data(), trend_prior(), hyperparameters)
                       .log_likelihood() +
                   prior_.about_trend.log_density(hyperparameters);
        } catch (std::invalid_argument const&) {
            return -std::numeric_limits<double>::infinity();  // numerically singular
        }
    };
    std::vector<inference::Bounds> bounds{logs_of({prior_.least_deviation, largest_deviation})};
    for (double const longest : longest_lengths(prior_, d))
        bounds.push_back(logs_of({shortest_length, longest}));
    if (is_noisy) bounds.push_back(logs_of(extra_noise_prior));
    inference::SamplerSettings const settings{.chains = chains,
                                              .warm_up = 400,
                                              .draws = 150,
                                              .most_draws = 150,
                                              .starts = starts_about(process_.hyperparameters(), bounds)};
    inference::Sample const sample = inference::sample(density, bounds, settings);
    for (int chain = 0; chain < sample.chains; ++chain) {
        for (int draw = thinning - 1; draw < sample.draws; draw += thinning)
            others_.emplace_back(process_.data(), trend_prior(), from_logs(sample.draw(chain, draw)));
    }
}

}  // namespace vibrotrough::atlas
