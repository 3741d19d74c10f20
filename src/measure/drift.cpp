#include "measure/drift.hpp"

#include "measure/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vibrotrough::measure {
namespace {

constexpr Eigen::Index fewest_cycles_of_fit = 8;
/// Squares of standard errors that do not count as a drift.
constexpr double tolerated_noise = 2;
/// Of the sums of squares of two fits, in variances: three standard deviations.
constexpr double agreement = 9;

/// Of efficiencies, which are of order one.
constexpr double rounding = 1e-12;

/// A decay that was fitted to every run.
struct Fit {
    double explained;  ///< by how much it lowers the sum of squares of the mean over all runs
    double left;       ///< in the mean of the cycles kept
};

/// @param shape  f(i) of all cycles
/// @param first  cycle of the fit
/// @param variance  of the mean of a cycle over all runs
Fit fit(Runs runs, Eigen::ArrayXd const& shape, Eigen::Index first, Eigen::Index discarded, double variance) {
    Eigen::Index const n = shape.size(), fitted = n - first;
    Eigen::ArrayXd const centred = shape.tail(fitted) - shape.tail(fitted).mean();
    double const norm = centred.square().sum();
    Eigen::ArrayXd amplitudes(static_cast<Eigen::Index>(runs.size()));
    for (std::size_t i = 0; i < runs.size(); ++i)
        amplitudes[static_cast<Eigen::Index>(i)] = (centred * as_array(runs[i]).tail(fitted)).sum() / norm;
    auto const count = static_cast<double>(runs.size());
    double const mean = amplitudes.mean();
    // The amplitudes of a few runs can agree by chance, but not better than independent cycles allow.
    double const error_squared =
        std::max((amplitudes - mean).square().sum() / (count * (count - 1)), variance / norm);
    double const certain = std::sqrt(std::max(0.0, mean * mean - tolerated_noise * error_squared));
    if (certain < rounding) return {mean * mean * norm, 0};
    return {mean * mean * norm, certain * shape.tail(n - discarded).mean()};
}

}  // namespace

double drift_left(Runs runs, int discarded) {
    auto const n = static_cast<Eigen::Index>(runs.front().size());
    if (runs.size() < 2 || n < fewest_cycles_of_fit) return 0;
    std::vector<std::span<double const>> kept;
    for (std::span<double const> const run : runs)
        kept.push_back(run.subspan(static_cast<std::size_t>(discarded)));
    double const variance = fluctuations_of(kept).variance / static_cast<double>(runs.size());
    Eigen::ArrayXd const cycle = Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1));

    std::vector<Fit> exponentials;
    for (double const part : {1, 2, 4, 8})
        exponentials.push_back(
            fit(runs, (-cycle * part / static_cast<double>(n)).exp(), 0, discarded, variance));
    double const best = std::ranges::max(exponentials, {}, &Fit::explained).explained;
    Eigen::Index const first = std::max<Eigen::Index>(1, n / 16);
    double left =
        fit(runs, 1 / (cycle.max(static_cast<double>(first)) + 0.5), first, discarded, variance).left;
    for (Fit const& one : exponentials)
        if (best - one.explained <= agreement * variance) left = std::max(left, one.left);
    return left;
}

}  // namespace vibrotrough::measure
