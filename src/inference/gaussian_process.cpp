#include "inference/gaussian_process.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace vibrotrough::inference {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// a^2 of the Matern covariance.
template <typename A, typename B>
double squared_distance(A const& a, B const& b, Vector const& lengths) {
    double sum = 0;
    for (Eigen::Index j = 0; j < lengths.size(); ++j) sum += std::pow((a(j) - b(j)) / lengths(j), 2);
    return 3 * sum;
}

double matern(double squared_a, double deviation) {
    double const a = std::sqrt(squared_a);
    return deviation * deviation * (1 + a) * std::exp(-a);
}

Matrix matern_of(Matrix const& inputs, Hyperparameters const& h) {
    Matrix result(inputs.rows(), inputs.rows());
    for (Eigen::Index i = 0; i < inputs.rows(); ++i) {
        for (Eigen::Index j = 0; j <= i; ++j)
            result(i, j) = result(j, i) =
                matern(squared_distance(inputs.row(i), inputs.row(j), h.lengths), h.deviation);
    }
    return result;
}

void check_hyperparameters(Hyperparameters const& h, Eigen::Index inputs) {
    if (!(h.deviation > 0) || h.lengths.size() != inputs || !(h.lengths.array() > 0).all() ||
        !(h.extra_noise >= 0))
        throw std::invalid_argument("GaussianProcess: a hyperparameter is out of range");
}

}  // namespace

ProcessValue mixture(std::vector<ProcessValue> const& parts) {
    double mean = 0, squares = 0;
    for (auto const& [m, sd] : parts) mean += m;
    mean /= static_cast<double>(parts.size());
    for (auto const& [m, sd] : parts) squares += sd * sd + (m - mean) * (m - mean);
    return {mean, std::sqrt(squares / static_cast<double>(parts.size()))};
}

void GaussianProcess::check(ProcessData const& d, TrendPrior const& p) {
    Eigen::Index const n = d.values.size();
    bool const fits = n > 0 && d.inputs.rows() == n && d.inputs.cols() > 0 && d.trend.rows() == n &&
                      d.noise.size() == n && p.mean.size() == d.trend.cols() && p.sd.size() == d.trend.cols();
    if (!fits) throw std::invalid_argument("GaussianProcess: the sizes of the data do not fit");
    bool const finite =
        d.inputs.allFinite() && d.trend.allFinite() && d.values.allFinite() && d.noise.allFinite();
    if (!finite || (d.noise.array() < 0).any() || (p.sd.array() <= 0).any())
        throw std::invalid_argument(
            "GaussianProcess: the data have a number that is not finite or out of range");
}

GaussianProcess::GaussianProcess(ProcessData data, TrendPrior prior, Hyperparameters hyperparameters)
    : data_(std::move(data)), prior_(std::move(prior)), hyperparameters_(std::move(hyperparameters)) {
    check(data_, prior_);
    check_hyperparameters(hyperparameters_, data_.inputs.cols());
    Matrix covariance = matern_of(data_.inputs, hyperparameters_) +
                        data_.trend * prior_.sd.cwiseAbs2().asDiagonal() * data_.trend.transpose();
    covariance.diagonal() += data_.noise.cwiseAbs2();
    covariance.diagonal().array() += hyperparameters_.extra_noise * hyperparameters_.extra_noise;
    factor_.compute(covariance);
    if (factor_.info() != Eigen::Success || factor_.rcond() < 1e-15)
        throw std::invalid_argument(
            "GaussianProcess: two values at one place contradict each other; give them noise");
    Vector const residual = data_.values - data_.trend * prior_.mean;
    weights_ = factor_.solve(residual);
    log_likelihood_ = -0.5 * residual.dot(weights_) - factor_.matrixLLT().diagonal().array().log().sum() -
                      0.5 * static_cast<double>(residual.size()) * std::log(2 * std::numbers::pi);
}

Vector GaussianProcess::log_likelihood_gradient() const {
    Eigen::Index const n = data_.values.size(), inputs = data_.inputs.cols();
    Matrix const inner = weights_ * weights_.transpose() - factor_.solve(Matrix::Identity(n, n));
    Vector gradient = Vector::Zero(inputs + 2);
    gradient(0) = inner.cwiseProduct(matern_of(data_.inputs, hyperparameters_)).sum();
    double const variance = hyperparameters_.deviation * hyperparameters_.deviation;
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < i; ++j) {
            double const a = std::sqrt(
                squared_distance(data_.inputs.row(i), data_.inputs.row(j), hyperparameters_.lengths));
            double const common = inner(i, j) * variance * std::exp(-a);
            for (Eigen::Index k = 0; k < inputs; ++k) {
                double const d = (data_.inputs(i, k) - data_.inputs(j, k)) / hyperparameters_.lengths(k);
                gradient(1 + k) += common * 3 * d * d;
            }
        }
    }
    gradient(inputs + 1) = inner.trace() * hyperparameters_.extra_noise * hyperparameters_.extra_noise;
    return gradient;
}

double GaussianProcess::prior_covariance(Vector const& xa, Vector const& ha, Vector const& xb,
                                         Vector const& hb) const {
    return matern(squared_distance(xa, xb, hyperparameters_.lengths), hyperparameters_.deviation) +
           ha.cwiseProduct(prior_.sd.cwiseAbs2()).dot(hb);
}

Vector GaussianProcess::covariances_with_data(Vector const& inputs, Vector const& trend) const {
    // Column by column, which the compiler computes several at a time: searches spend their time here.
    Eigen::ArrayXd squared = Eigen::ArrayXd::Zero(data_.values.size());
    for (Eigen::Index j = 0; j < inputs.size(); ++j)
        squared += ((data_.inputs.col(j).array() - inputs(j)) / hyperparameters_.lengths(j)).square();
    Eigen::ArrayXd const a = (3 * squared).sqrt();
    double const variance = hyperparameters_.deviation * hyperparameters_.deviation;
    return (variance * (1 + a) * (-a).exp()).matrix() +
           data_.trend * trend.cwiseProduct(prior_.sd.cwiseAbs2());
}

ProcessValue GaussianProcess::predict(Vector const& inputs, Vector const& trend) const {
    Vector const k = covariances_with_data(inputs, trend);
    double const variance =
        prior_covariance(inputs, trend, inputs, trend) - factor_.matrixL().solve(k).squaredNorm();
    return {trend.dot(prior_.mean) + k.dot(weights_), std::sqrt(std::max(0.0, variance))};
}

double GaussianProcess::mean(Vector const& inputs, Vector const& trend) const {
    return trend.dot(prior_.mean) + covariances_with_data(inputs, trend).dot(weights_);
}

double GaussianProcess::covariance(Vector const& xa, Vector const& ha, Vector const& xb,
                                   Vector const& hb) const {
    return prior_covariance(xa, ha, xb, hb) -
           covariances_with_data(xa, ha).dot(factor_.solve(covariances_with_data(xb, hb)));
}

std::vector<ProcessValue> GaussianProcess::leave_one_out() const {
    Eigen::Index const n = data_.values.size();
    Matrix const inverse = factor_.solve(Matrix::Identity(n, n));
    std::vector<ProcessValue> result;
    for (Eigen::Index i = 0; i < n; ++i)
        result.push_back({data_.values(i) - weights_(i) / inverse(i, i), 1 / std::sqrt(inverse(i, i))});
    return result;
}

}  // namespace vibrotrough::inference
