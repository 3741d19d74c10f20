#pragma once

#include <optional>
#include <span>

namespace vibrotrough::measure {

/// A mean that was measured with a numerical setting between its default and its limit.
struct RefinedMean {
    double coarseness;  ///< distance of the setting from its limit: 1 at the default, 0 at the limit
    double mean;        ///< of the measured quantity
    double half_width;  ///< of its confidence interval, >= 0
};

/// What is known of the error that a default setting makes.
enum class Convergence {
    extrapolated,  ///< the limit follows from a trend of known order
    resolved,      ///< the default differs significantly from the finest setting
    not_resolved,  ///< the difference is within its interval, which bounds it
};

/// The error of the default of one numerical setting: default minus limit.
struct NumericalError {
    Convergence verdict;  ///< how it was found
    double error;         ///< default minus limit, or minus the finest setting when it is not extrapolated
    double half_width;    ///< of its interval, at the confidence of the means

    /// What |error| is below at 95 %, when the error is normal with this mean and this half-width: the
    /// half-width where the mean is small, else |error| + 0.84 half_width (0.84 = 1.645 / 1.960, the ratio of
    /// the one-sided to the two-sided quantile).
    double bound() const;
};

/// The same error when it is also known beforehand that it lies within +-expected, at the same confidence:
/// the mean of what was measured and of zero, weighted by the inverse squares of both half-widths. An error
/// that contradicts what was expected, |error| > hypot(half_width, expected), stays as it was measured.
/// @param expected  half-width, > 0; infinite when nothing is known beforehand
NumericalError with_expected(NumericalError const& measured, double expected);

/// The difference a - b of two independent means; the half-widths add as the root of their squares.
NumericalError difference(RefinedMean const& a, RefinedMean const& b);

/// The error of a default setting.
///
/// The difference of the default from the finest setting is taken, unless the limit can be extrapolated
/// (Richardson). For that, the order p must be known, there must be three means or more, they must rise or
/// fall throughout, and the difference must be larger than its half-width. The line m = m_0 + b h^p, h the
/// coarseness, is then fitted by least squares with the weights 1 / half_width^2, and the error is b. If the
/// line misses a mean by more than the mean's half-width, the order is not that of the data and nothing is
/// extrapolated. The half-width of b is 1 / sqrt(sum w (h^p - <h^p>)^2) with w = 1 / half_width^2.
/// @param means  the default first, then with decreasing coarseness; at least two
/// @param order  p, > 0, if it is known
NumericalError numerical_error(std::span<RefinedMean const> means, std::optional<double> order);

}  // namespace vibrotrough::measure
