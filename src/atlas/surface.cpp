#include "atlas/surface.hpp"

#include "core/error.hpp"
#include "inference/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

namespace vibrotrough::atlas {
namespace {

/// 95 % of a normal distribution lie within so many standard deviations.
/// Below this probability extra noise is taken to be real.
constexpr double significant = 0.01;
/// A surface whose Q2 is below this does not predict.
constexpr double least_q2 = 0.5;
/// Smallest standard deviation of a point: two packings that happen to agree do not make it exact.
constexpr double least_noise = 1e-4;
/// Hyperparameters are equally likely in their logarithm within these bounds; lengths over the scaled inputs.
constexpr inference::Bounds deviation_prior{0.005, 1}, length_prior{0.05, 5}, extra_noise_prior{1e-3, 1};
/// Every 25th draw of the posterior is used: 24 of four chains.
constexpr int thinning = 25;

inference::Bounds logs_of(inference::Bounds const& b) {
    return {std::log(b.low), std::log(b.high)};
}

/// The mean and the standard deviation of a mixture of normal distributions that are equally likely.
inference::ProcessValue mixture(std::vector<inference::ProcessValue> const& parts) {
    double mean = 0, squares = 0;
    for (auto const& [m, sd] : parts) mean += m;
    mean /= static_cast<double>(parts.size());
    for (auto const& [m, sd] : parts) squares += sd * sd + (m - mean) * (m - mean);
    return {mean, std::sqrt(squares / static_cast<double>(parts.size()))};
}

SurfaceQuality judge(std::vector<inference::GaussianProcess> const& processes, double extra_noise,
                     double extra_noise_p) {
    std::vector<std::vector<inference::ProcessValue>> left_out;
    for (auto const& process : processes) left_out.push_back(process.leave_one_out());
    auto const& values = processes.front().data().values;
    double const mean = values.mean();
    double errors = 0, about_mean = 0;
    SurfaceQuality q{static_cast<int>(values.size()), 0, 0, 0, 0, extra_noise, extra_noise_p};
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        std::vector<inference::ProcessValue> parts;
        for (auto const& one : left_out) parts.push_back(one[static_cast<std::size_t>(i)]);
        auto const [predicted, sd] = mixture(parts);
        double const error = values(i) - predicted;
        errors += error * error;
        about_mean += std::pow(values(i) - mean, 2);
        q.covered += std::abs(error) <= deviations_in_half_width * sd ? 1 : 0;
    }
    q.q2 = about_mean > 0 ? 1 - errors / about_mean : 0;
    boost::math::binomial const band(q.points, 0.95);
    q.least_covered = static_cast<int>(std::floor(boost::math::quantile(band, 0.025)));
    q.most_covered = static_cast<int>(std::ceil(boost::math::quantile(boost::math::complement(band, 0.025))));
    return q;
}

}  // namespace

Surface::Surface(std::vector<SurfaceInput> inputs, std::vector<SurfacePoint> points, Trend trend)
    : inputs_(std::move(inputs)), points_(std::move(points)), trend_(trend), process_(fit()) {
    draw_others();
    quality_ = judge(others_, process_.hyperparameters().extra_noise, quality_.extra_noise_p);
}

Surface::Surface(std::vector<SurfaceInput> inputs, std::vector<SurfacePoint> points,
                 std::vector<inference::Hyperparameters> const& draws)
    : inputs_(std::move(inputs)),
      points_(std::move(points)),
      trend_(Trend::theory),
      process_(data(), prior(), draws.empty() ? inference::Hyperparameters{} : draws.front()) {
    for (inference::Hyperparameters const& draw : draws) others_.emplace_back(process_.data(), prior(), draw);
    quality_ = judge(others_, process_.hyperparameters().extra_noise, 0);
}

std::vector<inference::Hyperparameters> Surface::draws() const {
    std::vector<inference::Hyperparameters> all;
    for (inference::GaussianProcess const& process : others_) all.push_back(process.hyperparameters());
    return all;
}

inference::ProcessData Surface::data() const {
    auto const n = static_cast<Eigen::Index>(points_.size());
    auto const d = static_cast<Eigen::Index>(inputs_.size());
    Eigen::Index const functions = trend_at(0).size();
    inference::ProcessData data{Eigen::MatrixXd(n, d), Eigen::MatrixXd(n, functions), Eigen::VectorXd(n),
                                Eigen::VectorXd(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
        SurfacePoint const& point = points_[static_cast<std::size_t>(i)];
        data.inputs.row(i) = scaled(point.place);
        data.trend.row(i) = trend_at(point.theory);
        data.values(i) = point.efficiency;
        data.noise(i) = std::max(least_noise, point.half_width / deviations_in_half_width);
    }
    return data;
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
    auto process = inference::GaussianProcess::fitted(known, prior(), settings);
    settings.has_extra_noise = true;
    auto const noisy = inference::GaussianProcess::fitted(known, prior(), settings);
    // Extra noise cannot be negative, so that half of the likelihood ratio's distribution lies at zero (H.
    // Chernoff, Ann. Math. Stat. 25 (1954) 573-578).
    double const ratio = std::max(0.0, 2 * (noisy.log_likelihood() - process.log_likelihood()));
    double const p = 0.5 * boost::math::cdf(boost::math::complement(boost::math::chi_squared(1), ratio));
    if (p < significant) process = noisy;
    quality_.extra_noise_p = p;
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
            return inference::GaussianProcess(process_.data(), prior(), from_logs(logs)).log_likelihood();
        } catch (std::invalid_argument const&) {
            return -std::numeric_limits<double>::infinity();  // numerically singular
        }
    };
    std::vector<inference::Bounds> bounds{logs_of(deviation_prior)};
    for (Eigen::Index j = 0; j < d; ++j) bounds.push_back(logs_of(length_prior));
    if (is_noisy) bounds.push_back(logs_of(extra_noise_prior));
    inference::SamplerSettings const settings{
        .chains = 4, .warm_up = 200, .draws = 150, .most_draws = 150, .points_per_start = 150};
    inference::Sample const sample = inference::sample(density, bounds, settings);
    for (int chain = 0; chain < sample.chains; ++chain) {
        for (int draw = thinning - 1; draw < sample.draws; draw += thinning)
            others_.emplace_back(process_.data(), prior(), from_logs(sample.draw(chain, draw)));
    }
}

Eigen::VectorXd Surface::scaled(Place const& place) const {
    Eigen::VectorXd x(static_cast<Eigen::Index>(inputs_.size()));
    for (std::size_t k = 0; k < inputs_.size(); ++k)
        x(static_cast<Eigen::Index>(k)) = (place[k] - inputs_[k].low) / (inputs_[k].high - inputs_[k].low);
    return x;
}

inference::TrendPrior Surface::prior() const {
    if (trend_ == Trend::theory) return {Eigen::VectorXd{{0, 1}}, Eigen::VectorXd{{1, 1}}};
    return {Eigen::VectorXd{{0.5}}, Eigen::VectorXd{{1}}};
}

Eigen::VectorXd Surface::trend_at(double theory) const {
    return trend_ == Trend::theory ? Eigen::VectorXd{{1, theory}} : Eigen::VectorXd{{1}};
}

SurfaceValue Surface::at(Place const& place, double theory) const {
    Eigen::VectorXd const x = scaled(place), h = trend_at(theory);
    std::vector<inference::ProcessValue> parts;
    for (inference::GaussianProcess const& process : others_) parts.push_back(process.predict(x, h));
    auto const [mean, sd] = mixture(parts);
    return {mean, deviations_in_half_width * sd};
}

double Surface::variance_reduction(Place const& place, double theory, Place const& where, double theory_there,
                                   double half_width) const {
    Eigen::VectorXd const x = scaled(where), h = trend_at(theory_there);
    double const covariance = process_.covariance(scaled(place), trend_at(theory), x, h);
    double const extra = process_.hyperparameters().extra_noise;
    double const noise = half_width / deviations_in_half_width;
    double const variance = std::pow(process_.predict(x, h).sd, 2) + noise * noise + extra * extra;
    return variance > 0 ? covariance * covariance / variance : 0;
}

void Surface::believe(SurfacePoint const& point) {
    inference::ProcessData data = process_.data();
    Eigen::Index const n = data.values.size();
    data.inputs.conservativeResize(n + 1, Eigen::NoChange);
    data.trend.conservativeResize(n + 1, Eigen::NoChange);
    data.values.conservativeResize(n + 1);
    data.noise.conservativeResize(n + 1);
    data.inputs.row(n) = scaled(point.place);
    data.trend.row(n) = trend_at(point.theory);
    data.values(n) = point.efficiency;
    data.noise(n) = std::max(least_noise, point.half_width / deviations_in_half_width);
    process_ = inference::GaussianProcess(data, prior(), process_.hyperparameters());
    for (inference::GaussianProcess& process : others_)
        process = inference::GaussianProcess(data, prior(), process.hyperparameters());
    points_.push_back(point);
}

std::vector<std::string> Surface::doubts() const {
    std::vector<std::string> doubts;
    if (quality_.q2 < least_q2) {
        doubts.push_back(
            fmt::format("Points that are left out are not predicted (Q2 = {:.2f}, where 1 is perfect and 0 "
                        "is no better than "
                        "the mean): the inputs do not explain the efficiencies, or there are too few points.",
                        quality_.q2));
    }
    if (!quality_.coverage_is_right()) {
        doubts.push_back(
            fmt::format("{} of {} points lie within the 95 % intervals that the others predict, where {} to "
                        "{} are to be expected: "
                        "the intervals of the surface are {}.",
                        quality_.covered, quality_.points, quality_.least_covered, quality_.most_covered,
                        quality_.covered < quality_.least_covered ? "too narrow" : "too wide"));
    }
    if (quality_.extra_noise > 0) {
        doubts.push_back(
            fmt::format("The points scatter by {:.2g} (standard deviation) more than their intervals say (p "
                        "= {:.1g}): the intervals "
                        "are too narrow, or the efficiency changes faster than the points can show.",
                        quality_.extra_noise, quality_.extra_noise_p));
    }
    return doubts;
}

}  // namespace vibrotrough::atlas
