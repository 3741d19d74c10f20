#include "inference/gaussian_process.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <nlopt.hpp>

namespace vibrotrough::inference {
namespace {

/// Hyperparameters as the logarithms among which NLopt searches.
Hyperparameters from_logs(std::vector<double> const& logs, Eigen::Index inputs, bool has_extra_noise) {
    Hyperparameters h{std::exp(logs[0]), Eigen::VectorXd(inputs), 0};
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

/// How far a number lies from its median, in standard deviations of its logarithm.
double deviations_of(LogNormal const& known, double value) {
    return std::log(value / known.median) / known.log_sd;
}

/// The likelihood, with what is known of the hyperparameters, as NLopt asks for it.
struct Likelihood {
    ProcessData const& data;
    TrendPrior const& prior;
    HyperparameterPrior const& known;
    bool has_extra_noise;

    static double value(std::vector<double> const& logs, std::vector<double>& gradient, void* self) {
        auto const& me = *static_cast<Likelihood const*>(self);
        try {
            GaussianProcess const process(me.data, me.prior,
                                          from_logs(logs, me.data.inputs.cols(), me.has_extra_noise));
            if (!gradient.empty()) {
                Eigen::VectorXd const g =
                    process.log_likelihood_gradient() + me.known.gradient(process.hyperparameters());
                for (std::size_t k = 0; k < gradient.size(); ++k)
                    gradient[k] = g(static_cast<Eigen::Index>(k));
            }
            return process.log_likelihood() + me.known.log_density(process.hyperparameters());
        } catch (std::invalid_argument const&) {  // numerically singular here
            for (double& g : gradient) g = 0;
            return -1e10;
        }
    }
};

}  // namespace

double HyperparameterPrior::log_density(Hyperparameters const& hyperparameters) const {
    double sum = deviation ? std::pow(deviations_of(*deviation, hyperparameters.deviation), 2) : 0;
    for (std::size_t j = 0; j < lengths.size(); ++j) {
        if (!lengths[j]) continue;
        double const length = hyperparameters.lengths(static_cast<Eigen::Index>(j));
        sum += std::pow(deviations_of(*lengths[j], length), 2);
    }
    return -sum / 2;
}

Eigen::VectorXd HyperparameterPrior::gradient(Hyperparameters const& hyperparameters) const {
    Eigen::VectorXd slopes = Eigen::VectorXd::Zero(hyperparameters.lengths.size() + 2);
    if (deviation) slopes(0) = -deviations_of(*deviation, hyperparameters.deviation) / deviation->log_sd;
    for (std::size_t j = 0; j < lengths.size(); ++j) {
        if (!lengths[j]) continue;
        auto const at = static_cast<Eigen::Index>(j);
        slopes(1 + at) = -deviations_of(*lengths[j], hyperparameters.lengths(at)) / lengths[j]->log_sd;
    }
    return slopes;
}

void HyperparameterPrior::check(Eigen::Index inputs) const {
    auto const has_sense = [](std::optional<LogNormal> const& one) {
        return !one || (one->median > 0 && one->log_sd > 0);
    };
    bool const fits = lengths.empty() || static_cast<Eigen::Index>(lengths.size()) == inputs;
    if (!fits || !has_sense(deviation) || !std::ranges::all_of(lengths, has_sense))
        throw std::invalid_argument("GaussianProcess: what is known of the hyperparameters has no sense");
}

GaussianProcess GaussianProcess::fitted(ProcessData data, TrendPrior prior, ProcessSettings const& settings) {
    check(data, prior);
    Eigen::Index const inputs = data.inputs.cols();
    settings.prior.check(inputs);
    std::vector<double> const low = logs_of(settings.least, 0.05, inputs, settings.has_extra_noise);
    std::vector<double> const high = logs_of(settings.most, 20, inputs, settings.has_extra_noise);
    Likelihood likelihood{data, prior, settings.prior, settings.has_extra_noise};
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

}  // namespace vibrotrough::inference
