#include "measure/estimate.hpp"

#include "measure/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace vibrotrough::measure {
namespace {

using ValueMap = Eigen::Map<Eigen::ArrayXd const>;

double sample_deviation(ValueMap const& values) {
    if (values.size() < 2) return 0;
    return std::sqrt((values - values.mean()).square().sum() / static_cast<double>(values.size() - 1));
}

/// The half-width of the confidence interval of the mean of `values` with the statistical inefficiency g.
double mean_half_width(ValueMap const& values, double g, double confidence) {
    double const independent = static_cast<double>(values.size()) / g;
    // Fewer than two independent values do not allow an interval.
    if (!(independent >= 2)) return std::numeric_limits<double>::infinity();
    return student_quantile(confidence, independent - 1) * sample_deviation(values) / std::sqrt(independent);
}

bool drifts(std::span<double const> kept, double g, Precision const& wanted) {
    std::size_t const third = kept.size() / 3;
    ValueMap const first = as_array(kept.first(third));
    ValueMap const last = as_array(kept.last(third));
    double const difference = std::abs(last.mean() - first.mean());
    double const tolerated =
        std::hypot(mean_half_width(first, g, wanted.confidence), mean_half_width(last, g, wanted.confidence));
    return difference > tolerated && difference > wanted.half_width;
}

/// Whether the start-up is not over: the result of MSER is the middle of the run, and the mean of the second
/// quarter still differs from that of the second half by more than the required half-width.
bool still_starting_up(std::span<double const> values, PackingEstimate const& estimate,
                       Precision const& wanted) {
    std::size_t const n = values.size();
    if (2 * static_cast<std::size_t>(estimate.discarded) + 1 < n) return false;
    if (n < 4) return true;
    double const before = as_array(values.subspan(n / 4, n / 4)).mean();
    return std::abs(before - estimate.mean) > wanted.half_width;
}

}  // namespace

std::vector<double> velocity_efficiency(CycleSeries const& series, double amplitude_x) {
    if (!(amplitude_x > 0)) throw std::invalid_argument("velocity efficiency needs a drive along the trough");
    std::vector<double> eta;
    for (std::size_t k = 1; k < series.x.size(); ++k) {
        eta.push_back((series.x[k] - series.x[k - 1]) / (2 * std::numbers::pi * amplitude_x));
    }
    return eta;
}

std::vector<double> velocity_efficiency_by_mean(CycleSeries const& series, double velocity_scale) {
    if (!(velocity_scale > 0))
        throw std::invalid_argument("velocity efficiency needs a drive along the trough");
    std::vector<double> eta = series.mean_velocity;
    for (double& value : eta) value /= velocity_scale;
    return eta;
}

int pooled_startup_length(Runs runs) {
    int const n = static_cast<int>(runs.front().size());
    std::vector<double> squares(runs.front().size(), 0.0);  // without the first d cycles
    for (std::span<double const> const run : runs) {
        // Sums from the end give the sums without the first d values for every d.
        double const origin = n > 0 ? run.back() : 0;  // the squares of small numbers are more accurate
        double sum = 0, square = 0;
        for (int d = n - 1; d >= 0; --d) {
            double const value = run[static_cast<std::size_t>(d)] - origin;
            sum += value;
            square += value * value;
            squares[static_cast<std::size_t>(d)] += std::max(0.0, square - sum * sum / (n - d));
        }
    }
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int d = 0; 2 * d <= n && d < n; ++d) {
        double const size = n - d;
        double const error = squares[static_cast<std::size_t>(d)] / (size * size);
        if (!(error < least)) continue;  // of equal errors, take the shortest start-up
        least = error;
        best = d;
    }
    return best;
}

int startup_length(std::span<double const> values) {
    return pooled_startup_length(Runs(&values, 1));
}

Fluctuations fluctuations_of(Runs runs) {
    auto const n = static_cast<Eigen::Index>(runs.front().size());
    Eigen::ArrayXd sums = Eigen::ArrayXd::Zero(std::max<Eigen::Index>(2, n / 2));  // at each lag
    double rounding = 0;
    for (std::span<double const> const run : runs) {
        ValueMap const y = as_array(run);
        double const mean = n > 0 ? y.mean() : 0;
        Eigen::ArrayXd const centred = y - mean;
        for (Eigen::Index lag = 0; lag < std::min(sums.size(), n); ++lag)
            sums[lag] += (centred.head(n - lag) * centred.tail(n - lag)).sum();
        rounding += static_cast<double>(n) * std::pow(1e-12 * mean, 2);
    }
    double const freedom = static_cast<double>(runs.size()) * static_cast<double>(n - 1);
    Fluctuations found{freedom > 0 ? sums[0] / freedom : 0, 1};
    if (n < 4 || sums[0] <= rounding) return found;  // values that never change, up to rounding
    sums /= double(sums[0]);
    // The pair sums rho_2m + rho_2m+1 of a reversible series are positive; the first one that is not is
    // noise.
    double sum = 0;
    for (Eigen::Index m = 0; 2 * m + 1 < sums.size(); ++m) {
        double const pair = sums[2 * m] + sums[2 * m + 1];
        if (pair <= 0) break;
        sum += pair;
    }
    double const size = static_cast<double>(n);
    double const rho = std::min(sums[1] + (1 + 3 * sums[1]) / size, 1 - 1 / size);
    found.inefficiency = std::clamp(std::max(2 * sum - 1, (1 + rho) / (1 - rho)), 1.0, size);
    return found;
}

double statistical_inefficiency(std::span<double const> values) {
    double const most = std::max(1.0, static_cast<double>(values.size()) / 2);
    return std::min(fluctuations_of(Runs(&values, 1)).inefficiency, most);
}

PackingEstimate estimate_packing(std::span<double const> values, Precision const& wanted) {
    return estimate_packing_after(startup_length(values), values, wanted);
}

PackingEstimate estimate_packing_after(int discarded, std::span<double const> values,
                                       Precision const& wanted) {
    int const n = static_cast<int>(values.size());
    std::span<double const> const kept = values.subspan(static_cast<std::size_t>(discarded));
    double const g = statistical_inefficiency(kept);
    PackingEstimate estimate{std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(),
                             discarded,
                             n - discarded,
                             g,
                             Verdict::not_steady};
    if (kept.empty()) return estimate;
    estimate.mean = as_array(kept).mean();
    estimate.half_width = mean_half_width(as_array(kept), g, wanted.confidence);
    if (still_starting_up(values, estimate, wanted) || drifts(kept, g, wanted)) return estimate;
    bool const enough = estimate.measured >= fewest_cycles && estimate.measured >= fewest_independent * g;
    estimate.verdict =
        enough && estimate.half_width <= wanted.half_width ? Verdict::precise : Verdict::not_precise;
    return estimate;
}

}  // namespace vibrotrough::measure
