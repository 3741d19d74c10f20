#include "atlas/surface.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::atlas {
namespace {

/// Smallest standard deviation of a point: two packings that happen to agree do not make it exact.
constexpr double least_noise = 1e-4;

}  // namespace

double SurfaceInput::share_of(double value) const {
    if (is_logarithmic) return std::log(value / low) / std::log(high / low);
    return (value - low) / (high - low);
}

double SurfaceInput::value_at(double share) const {
    if (is_logarithmic) return low * std::pow(high / low, share);
    return low + (high - low) * share;
}

Surface::Surface(std::vector<SurfaceInput> inputs, std::vector<SurfacePoint> points,
                 std::vector<inference::Hyperparameters> const& draws)
    : inputs_(std::move(inputs)),
      points_(std::move(points)),
      process_(data(), trend_prior(), draws.empty() ? inference::Hyperparameters{} : draws.front()) {
    others_.reserve(draws.size());
    others_.push_back(process_);
    for (std::size_t i = 1; i < draws.size(); ++i)
        others_.emplace_back(process_.data(), trend_prior(), draws[i]);
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

Eigen::VectorXd Surface::scaled(Place const& place) const {
    Eigen::VectorXd x(static_cast<Eigen::Index>(inputs_.size()));
    for (std::size_t k = 0; k < inputs_.size(); ++k)
        x(static_cast<Eigen::Index>(k)) = inputs_[k].share_of(place[k]);
    return x;
}

inference::TrendPrior Surface::trend_prior() const {
    if (prior_.trend == Trend::theory)
        return {Eigen::VectorXd{{0, 1}}, Eigen::VectorXd{{prior_.offset_sd, prior_.slope_sd}}};
    return {Eigen::VectorXd{{0.5}}, Eigen::VectorXd{{1}}};
}

Eigen::VectorXd Surface::trend_at(double theory) const {
    return prior_.trend == Trend::theory ? Eigen::VectorXd{{1, theory}} : Eigen::VectorXd{{1}};
}

SurfaceValue Surface::at(Place const& place, double theory) const {
    Eigen::VectorXd const x = scaled(place), h = trend_at(theory);
    std::vector<inference::ProcessValue> parts;
    for (inference::GaussianProcess const& process : others_) parts.push_back(process.predict(x, h));
    auto const [mean, sd] = inference::mixture(parts);
    return {mean, deviations_in_half_width * sd};
}

double Surface::efficiency_at(Place const& place, double theory) const {
    Eigen::VectorXd const x = scaled(place), h = trend_at(theory);
    double sum = 0;
    for (inference::GaussianProcess const& process : others_) sum += process.mean(x, h);
    return sum / static_cast<double>(others_.size());
}

SurfaceValue Surface::nearly_at(Place const& place, double theory) const {
    auto const [mean, sd] = process_.predict(scaled(place), trend_at(theory));
    return {mean, deviations_in_half_width * sd};
}

double Surface::near_efficiency_at(Place const& place, double theory) const {
    return process_.mean(scaled(place), trend_at(theory));
}

SurfaceValue Surface::difference(Place const& place, double theory, Place const& other,
                                 double theory_there) const {
    Eigen::VectorXd const xa = scaled(place), ha = trend_at(theory);
    Eigen::VectorXd const xb = scaled(other), hb = trend_at(theory_there);
    std::vector<inference::ProcessValue> parts;
    for (inference::GaussianProcess const& process : others_) {
        auto const a = process.predict(xa, ha), b = process.predict(xb, hb);
        double const variance = a.sd * a.sd + b.sd * b.sd - 2 * process.covariance(xa, ha, xb, hb);
        parts.push_back({a.mean - b.mean, std::sqrt(std::max(0.0, variance))});
    }
    auto const [mean, sd] = inference::mixture(parts);
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

double scatter_half_width(Surface const& surface) {
    auto const draws = surface.draws();
    double variance = 0;
    for (inference::Hyperparameters const& draw : draws)
        variance += draw.extra_noise * draw.extra_noise / static_cast<double>(draws.size());
    return deviations_in_half_width * std::sqrt(variance);
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
    process_ = inference::GaussianProcess(data, trend_prior(), process_.hyperparameters());
    for (inference::GaussianProcess& process : others_)
        process = inference::GaussianProcess(data, trend_prior(), process.hyperparameters());
    points_.push_back(point);
}

}  // namespace vibrotrough::atlas
