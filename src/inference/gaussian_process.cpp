#include "inference/gaussian_process.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>

#include <nlopt.hpp>

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

void check(ProcessData const& d, TrendPrior const& p) {
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

void check(Hyperparameters const& h, Eigen::Index inputs) {
    if (!(h.deviation > 0) || h.lengths.size() != inputs || !(h.lengths.array() > 0).all() ||
        !(h.extra_noise >= 0))
        throw std::invalid_argument("GaussianProcess: a hyperparameter is out of range");
}

/// Hyperparameters as the logarithms among which NLopt searches.
Hyperparameters from_logs(std::vector<double> const& logs, Eigen::Index inputs, bool has_extra_noise) {
    Hyperparameters h{std::exp(logs[0]), Vector(inputs), 0};
    for (Eigen::Index j = 0; j < inputs; ++j) h.lengths(j) = std::exp(logs[static_cast<std::size_t>(1 + j)]);
    if (has_extra_noise) h.extra_noise = std::exp(logs.back());
    return h;
}

std::vector<double> logs_of(Hyperparameters const& h, double length, Eigen::Index inputs,
                            bool has_extra_noise) {
    std::vector<double> logs{std::log(h.deviation)};
    for (Eigen::Index j = 0; j < inputs; ++j)
        logs.push_back(std::log(h.lengths.size() > 0 ? h.lengths(j) : length));
    if (has_extra_noise) logs.push_back(std::log(h.extra_noise));
    return logs;
}

/// The likelihood as NLopt asks for it.
struct Likelihood {
    ProcessData const& data;
    TrendPrior const& prior;
    bool has_extra_noise;

    static double value(std::vector<double> const& logs, std::vector<double>& gradient, void* self) {
        auto const& me = *static_cast<Likelihood const*>(self);
        try {
            GaussianProcess const process(me.data, me.prior,
                                          from_logs(logs, me.data.inputs.cols(), me.has_extra_noise));
            if (!gradient.empty()) {
                Vector const g = process.log_likelihood_gradient();
                for (std::size_t k = 0; k < gradient.size(); ++k)
                    gradient[k] = g(static_cast<Eigen::Index>(k));
            }
            return process.log_likelihood();
        } catch (std::invalid_argument const&) {  // numerically singular here
            for (double& g : gradient) g = 0;
            return -1e10;
        }
    }
};

}  // namespace

GaussianProcess::GaussianProcess(ProcessData data, TrendPrior prior, Hyperparameters hyperparameters)
    : data_(std::move(data)), prior_(std::move(prior)), hyperparameters_(std::move(hyperparameters)) {
    check(data_, prior_);
    check(hyperparameters_, data_.inputs.cols());
    matern_ = matern_of(data_.inputs, hyperparameters_);
    Matrix covariance = matern_ + data_.trend * prior_.sd.cwiseAbs2().asDiagonal() * data_.trend.transpose();
    covariance.diagonal() += data_.noise.cwiseAbs2();
    covariance.diagonal().array() += hyperparameters_.extra_noise * hyperparameters_.extra_noise;
    factor_.compute(covariance);
    if (factor_.info() != Eigen::Success || factor_.rcond() < 1e-15)
        throw std::invalid_argument(
            "GaussianProcess: two values at one place contradict each other; give them noise");
    Vector const residual = data_.values - data_.trend * prior_.mean;
    weights_ = factor_.solve(residual);
    Matrix const lower = factor_.matrixL();
    log_likelihood_ = -0.5 * residual.dot(weights_) - lower.diagonal().array().log().sum() -
                      0.5 * static_cast<double>(residual.size()) * std::log(2 * std::numbers::pi);
}

Vector GaussianProcess::log_likelihood_gradient() const {
    Eigen::Index const n = data_.values.size(), inputs = data_.inputs.cols();
    Matrix const inner = weights_ * weights_.transpose() - factor_.solve(Matrix::Identity(n, n));
    Vector gradient = Vector::Zero(inputs + 2);
    gradient(0) = inner.cwiseProduct(matern_).sum();
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

GaussianProcess GaussianProcess::fitted(ProcessData data, TrendPrior prior, ProcessSettings const& settings) {
    check(data, prior);
    Eigen::Index const inputs = data.inputs.cols();
    std::vector<double> const low = logs_of(settings.least, 0.05, inputs, settings.has_extra_noise);
    std::vector<double> const high = logs_of(settings.most, 20, inputs, settings.has_extra_noise);
    Likelihood likelihood{data, prior, settings.has_extra_noise};
    std::mt19937_64 random(settings.seed);
    double best = -std::numeric_limits<double>::infinity();
    std::vector<double> at;
    for (int start = 0; start < settings.starts; ++start) {
        nlopt::opt search(nlopt::LD_LBFGS, static_cast<unsigned>(low.size()));
        search.set_lower_bounds(low);
        search.set_upper_bounds(high);
        search.set_max_objective(Likelihood::value, &likelihood);
        search.set_xtol_abs(1e-9);
        search.set_maxeval(300);
        std::vector<double> point;
        for (std::size_t k = 0; k < low.size(); ++k) {
            double const u = static_cast<double>(random() >> 11U) * 0x1p-53;  // the same on every machine
            point.push_back(low[k] + (high[k] - low[k]) * u);
        }
        double value = -std::numeric_limits<double>::infinity();
        try {
            search.optimize(point, value);
        } catch (nlopt::roundoff_limited const&) {
            std::vector<double> none;
            value = Likelihood::value(point, none, &likelihood);
        } catch (std::runtime_error const&) {
            continue;  // LBFGS gives up where the likelihood is flat; the other starts go on
        }
        if (value > best) {
            best = value;
            at = point;
        }
    }
    if (at.empty()) throw std::invalid_argument("GaussianProcess: no hyperparameters have a likelihood");
    Hyperparameters const h = from_logs(at, inputs, settings.has_extra_noise);
    return {std::move(data), std::move(prior), h};
}

double GaussianProcess::prior_covariance(Vector const& xa, Vector const& ha, Vector const& xb,
                                         Vector const& hb) const {
    return matern(squared_distance(xa, xb, hyperparameters_.lengths), hyperparameters_.deviation) +
           ha.cwiseProduct(prior_.sd.cwiseAbs2()).dot(hb);
}

Vector GaussianProcess::covariances_with_data(Vector const& inputs, Vector const& trend) const {
    Vector result(data_.values.size());
    for (Eigen::Index i = 0; i < result.size(); ++i)
        result(i) = prior_covariance(inputs, trend, data_.inputs.row(i), data_.trend.row(i));
    return result;
}

ProcessValue GaussianProcess::predict(Vector const& inputs, Vector const& trend) const {
    Vector const k = covariances_with_data(inputs, trend);
    double const variance =
        prior_covariance(inputs, trend, inputs, trend) - factor_.matrixL().solve(k).squaredNorm();
    return {trend.dot(prior_.mean) + k.dot(weights_), std::sqrt(std::max(0.0, variance))};
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
