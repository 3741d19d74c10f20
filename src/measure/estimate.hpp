#pragma once

#include "measure/cycle_series.hpp"

#include <optional>
#include <span>
#include <vector>

namespace vibrotrough::measure {

/// The quality of a mean.
enum class Verdict {
    precise,      ///< steady, and the half-width of the interval is at most the required one
    not_precise,  ///< steady, but the interval is still too wide
    not_steady,  ///< the start-up does not end within the first half of the run, or the values after it drift
};

/// The mean of the cycle values of one packing after the start-up.
struct PackingEstimate {
    double mean;        ///< of the cycles kept after the start-up
    double half_width;  ///< of the confidence interval of the mean, corrected for correlation between cycles
    int discarded;      ///< number of cycles discarded as start-up (by MSER)
    int measured;       ///< number of cycles kept
    double correlation_time;  ///< statistical inefficiency g >= 1: the cycles kept are equivalent to measured
                              ///< / g independent ones
    Verdict verdict;          ///< whether the mean may be used
};

/// The required confidence interval.
struct Precision {
    double confidence;  ///< confidence level, in [0.5, 1)
    double half_width;  ///< > 0, in the unit of the values
};

/// The smallest number of cycles kept, and of equivalent independent cycles, for which an interval is
/// trusted: the correlation of a shorter series cannot be estimated well enough.
constexpr int fewest_cycles = 20;
/// Fewest independent values that the cycles kept must be worth.
constexpr double fewest_independent = 3;

/// The velocity efficiency of each cycle: eta_k = (x_k - x_(k-1)) / (2 pi r cos(beta)).
/// @param amplitude_x  r cos(beta), m, > 0
std::vector<double> velocity_efficiency(CycleSeries const& series, double amplitude_x);

/// The velocity efficiency of each cycle from its mean velocity, for bodies whose positions are not unwrapped
/// at periodic boundaries by the engine: eta_k = v_k / (omega r cos(beta)).
/// @param velocity_scale  omega r cos(beta), m/s, > 0
std::vector<double> velocity_efficiency_by_mean(CycleSeries const& series, double velocity_scale);

/// Runs of equal length, one value per cycle each.
using Runs = std::span<std::span<double const> const>;

/// The length of the start-up by the marginal standard error rule MSER (White, Simulation 69, 1997, 323-334):
/// the d <= n/2 that minimises sum_{i >= d} (y_i - mean_d)^2 / (n - d)^2, with the sum of squares over all
/// runs, each about its own mean. A result of n/2 means that the start-up may not be over.
/// @param runs  at least one
int pooled_startup_length(Runs runs);
int startup_length(std::span<double const> values);  ///< of a single run

/// How the cycles of runs fluctuate, each about the mean of its run.
struct Fluctuations {
    double variance;      ///< of a cycle
    double inefficiency;  ///< g, at least 1 and at most the number of cycles
};

/// Fluctuations from sums over all runs. The statistical inefficiency g is the larger of
/// g = 1 + 2 sum rho_k over the initial positive sequence of pair sums (Geyer, Statistical Science 7, 1992,
/// 473-483) and that of a first-order autoregressive process, g = (1 + rho) / (1 - rho) with rho = rho_1 +
/// (1 + 3 rho_1) / n, which corrects the bias of a short series (Kendall, Biometrika 41, 1954, 403-404).
/// @param runs  at least one
Fluctuations fluctuations_of(Runs runs);

/// g of a single run, at most n / 2: an interval from two independent values is wide enough to be noticed.
double statistical_inefficiency(std::span<double const> values);

/// The mean of the cycle values of one packing: the start-up is discarded by MSER, and the half-width of the
/// interval is t_{n/g - 1} s sqrt(g / n). The series is not steady if MSER does not find the end of the
/// start-up in the first half and the mean of the second quarter differs from that of the second half by more
/// than the required half-width. It is also not steady if the means of the first and the last third of the
/// cycles kept differ by more than their combined intervals and by more than the required half-width. It is
/// not precise if fewer than 20 cycles, or cycles equivalent to fewer than 3 independent ones, are kept.
PackingEstimate estimate_packing(std::span<double const> values, Precision const& wanted);

/// The same with a start-up that is known otherwise.
/// @param discarded  number of cycles to leave out, at most the number of values
PackingEstimate estimate_packing_after(int discarded, std::span<double const> values,
                                       Precision const& wanted);

}  // namespace vibrotrough::measure
