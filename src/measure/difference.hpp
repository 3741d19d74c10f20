#pragma once

#include "measure/case_estimate.hpp"

#include <optional>

namespace vibrotrough::measure {

/// Half-width of the interval of the difference of two cases' means, statistics alone: Welch's, Student's t
/// with the degrees of freedom of Welch & Satterthwaite (Biometrika 34, 1947, 28-35), from the packings of
/// both. As for a single case, packings that are added until it is known well enough agree by chance more
/// often than others, and the level is level_after_stopping(). What is left of the start-ups is added as the
/// root of the sum of squares.
///
/// The packings are not paired: those of equal seeds are not correlated in cases that differ.
/// tests/measure/difference_test.cpp measures how often the interval holds the difference.
/// @return nothing for a case with fewer than two packings
std::optional<double> half_width_of_difference(CaseEstimate const& one, CaseEstimate const& other,
                                               double confidence);

}  // namespace vibrotrough::measure
