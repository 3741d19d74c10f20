#include "learn/calibration.hpp"

#include "core/error.hpp"
#include "inference/diagnostics.hpp"
#include "learn/joint_misfit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace vibrotrough::learn {
namespace {

constexpr double impossible = -std::numeric_limits<double>::infinity();
/// Draws of the posterior for which the misfits are worked out.
constexpr int draws_for_misfits = 1000;

Estimate estimate(FreeParameter const& parameter, std::vector<double> draws, double rhat, double ess) {
    Estimate e{parameter,
               inference::quantile(draws, 0.5),
               inference::quantile(draws, 0.025),
               inference::quantile(draws, 0.975),
               rhat,
               ess,
               std::move(draws),
               {},
               0,
               false};
    e.ranges = highest_density_ranges(e.draws);
    double width = 0;
    for (auto const [low, high] : e.ranges) width += high - low;
    e.remaining = std::min(1.0, width / (0.95 * (parameter.prior.high - parameter.prior.low)));
    e.identifiable = e.remaining <= 0.5;
    return e;
}

std::vector<Misfit> misfits(CalibrationModel const& model, inference::Sample const& sample,
                            std::size_t parameters, std::vector<MeasuredSpeed> const& speeds,
                            Eigen::MatrixXd const& common_errors) {
    int const total = sample.chains * sample.draws;
    int const step = std::max(1, total / draws_for_misfits);
    std::vector<Misfit> result;
    for (MeasuredSpeed const& measured : speeds) {
        std::vector<double> answers;
        double variance = 0;
        double const common_error = common_errors.row(static_cast<Eigen::Index>(result.size())).norm();
        for (int i = 0; i < total; i += step) {
            auto const draw = sample.draw(i / sample.draws, i % sample.draws).first(parameters);
            auto const answer = model(draw, measured);
            if (!answer) continue;  // cannot happen: the density is zero there
            answers.push_back(answer->speed);
            double const common = std::hypot(answer->common_sd, common_error * answer->trough_speed);
            variance += answer->sd * answer->sd + common * common;
        }
        variance /= static_cast<double>(answers.size());
        Misfit one{measured,
                   inference::quantile(answers, 0.5),
                   inference::quantile(answers, 0.025),
                   inference::quantile(answers, 0.975),
                   0,
                   common_error};
        one.in_uncertainties =
            (measured.speed - one.median) / std::hypot(measured.uncertainty, std::sqrt(variance));
        result.push_back(one);
    }
    return result;
}

/// Common errors beside further ones.
Eigen::MatrixXd beside(Eigen::MatrixXd const& errors, Eigen::MatrixXd const& more) {
    Eigen::MatrixXd all(errors.rows(), errors.cols() + more.cols());
    all.leftCols(errors.cols()) = errors;
    if (more.cols() > 0) all.rightCols(more.cols()) = more;
    return all;
}

}  // namespace

std::vector<inference::Bounds> highest_density_ranges(std::vector<double> const& draws) {
    constexpr std::size_t bins = 50;
    auto const [low, high] = std::ranges::minmax(draws);
    double const width = (high - low) / bins;
    if (!(width > 0)) return {{low, high}};
    std::array<std::size_t, bins> counts{};
    for (double const d : draws) ++counts[std::min(bins - 1, static_cast<std::size_t>((d - low) / width))];
    std::array<std::size_t, bins> order{};
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return counts[i]; });
    std::array<bool, bins> inside{};
    double held = 0;
    for (std::size_t i = 0; held < 0.95 * static_cast<double>(draws.size()); ++i) {
        inside[order[i]] = true;
        held += static_cast<double>(counts[order[i]]);
    }
    std::vector<inference::Bounds> ranges;
    for (std::size_t i = 0; i < bins; ++i) {
        if (!inside[i]) continue;
        double const from = low + width * static_cast<double>(i);
        if (!ranges.empty() && from - ranges.back().high < 2.5 * width) {
            ranges.back().high = from + width;
        } else {
            ranges.push_back({from, from + width});
        }
    }
    return ranges;
}

Calibration calibrate(CalibrationModel const& model, std::vector<FreeParameter> const& parameters,
                      std::vector<MeasuredSpeed> const& speeds, CalibrationSettings const& settings) {
    BestFit const best = best_fit(model, parameters, speeds, settings.common_error);
    bool const estimated = settings.discrepancy == Discrepancy::estimated;
    std::size_t const count = parameters.size();
    std::vector<inference::Bounds> bounds;
    for (FreeParameter const& p : parameters) bounds.push_back(p.prior);
    // The chains walk in log(delta), whose prior is uniform.
    if (estimated) bounds.push_back({std::log(discrepancy_prior.low), std::log(discrepancy_prior.high)});
    Eigen::MatrixXd const common =
        beside(same_error(speeds.size(), settings.common_error), settings.layer_errors);
    auto const density = [&](std::span<double const> point) {
        auto const misfit =
            joint_misfit(model, point.first(count), speeds, estimated ? std::exp(point.back()) : 0, common);
        return misfit ? -0.5 * (misfit->chi_square + misfit->log_determinant) : impossible;
    };
    inference::Sample const sample = inference::sample(density, bounds, settings.sampler);
    Calibration result{{},
                       {},
                       misfits(model, sample, count, speeds, common),
                       best,
                       sample.converged,
                       settings.layer_errors.cols() > 0};
    for (std::size_t p = 0; p < count; ++p)
        result.parameters.push_back(
            estimate(parameters[p], sample.of(static_cast<int>(p)), sample.rhat[p], sample.ess[p]));
    if (estimated) {
        std::vector<double> draws = sample.of(static_cast<int>(count));
        for (double& d : draws) d = std::exp(d);
        result.discrepancy = estimate({"model_discrepancy", "1", discrepancy_prior}, std::move(draws),
                                      sample.rhat.back(), sample.ess.back());
    }
    return result;
}

}  // namespace vibrotrough::learn
