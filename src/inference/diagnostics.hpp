#pragma once

#include <vector>

namespace vibrotrough::inference {

/// The draws of one quantity by several Markov chains of equal length.
struct Chains {
    std::vector<double> values;  ///< chain after chain
    int count;                   ///< number of chains, >= 1; each has at least 8 values
};

/// Rank-normalised split R-hat: each chain is cut into two halves, the values are replaced by the normal
/// quantiles of their ranks, and the variance between the halves is compared with that within them. The
/// result is the larger one of the draws themselves (which shows chains at different places) and of their
/// distances to the median (which shows chains of different width). About 1 when the chains agree; above 1.01
/// they should not be used.
///
/// Source: A. Vehtari, A. Gelman, D. Simpson, B. Carpenter, P.-C. Buerkner, Bayesian Analysis 16 (2021)
/// 667-718, Eqs. 1-4 and 14. NaN when all values are equal.
/// @throws std::invalid_argument when a chain has fewer than eight values
double rank_normalised_rhat(Chains const& chains);

/// How many independent draws would know the quantity as well: the smallest of the effective sample sizes of
/// the rank-normalised draws (for the median) and of the indicators of the lowest and highest 5 % (for the
/// ends of intervals). From the autocorrelation of the split chains, summed over Geyer's initial monotone
/// sequence (Vehtari et al. 2021, Eqs. 10-13).
/// @throws std::invalid_argument when a chain has fewer than eight values
double effective_sample_size(Chains const& chains);

/// The value below which a fraction `p` in [0, 1] of the values lies, interpolated linearly between the
/// sorted values (type 7 of Hyndman and Fan 1996). `values` has at least one value and is copied.
double quantile(std::vector<double> values, double p);

}  // namespace vibrotrough::inference
