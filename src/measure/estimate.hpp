#pragma once

#include "measure/cycle_series.hpp"

#include <span>
#include <vector>

namespace vibrotrough::measure {

/// How well a mean is known.
enum class Verdict {
    precise,      ///< steady, and the half-width is at most what was asked
    not_precise,  ///< steady, but the interval is too wide so far
    not_steady,   ///< the start-up has not ended within the first half, or the rest still drifts
};

/// Mean of one packing's cycle values after the start-up.
struct PackingEstimate {
    double mean;        ///< of the cycles kept
    double half_width;  ///< of the confidence interval of the mean, corrected for correlation between cycles
    int discarded;      ///< cycles cut as start-up (MSER)
    int measured;       ///< cycles kept
    double correlation_time;  ///< statistical inefficiency g >= 1: measured / g cycles are worth as many
                              ///< independent ones
    Verdict verdict;
};

/// Mean over independent packings.
struct CaseEstimate {
    double mean;
    double half_width;
    int packings;
};

}  // namespace vibrotrough::measure
