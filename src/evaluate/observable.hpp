#pragma once

#include "store/case_record.hpp"
#include "store/observable.hpp"

#include <vector>

namespace vibrotrough::evaluate {

/// The values of an observable in one packing.
struct ObservedPacking {
    int number;  ///< of the packing
    /// Of each cycle of the result: one value for a number, else one for each point of the curve. NaN where a
    /// curve has no value.
    std::vector<std::vector<double>> cycles;
};

/// The mean of an observable over the packings of a case, with its interval: as the velocity efficiency, from
/// the same functions (measure::estimate_case, and Student's t for drives of given length). Start-up is what
/// MSER finds in the efficiency of the case, or in the observable where that is longer; a curve has one
/// start-up. Cycles at the beginning without a value are part of it, and a point that later has no value in a
/// cycle has no mean.
/// @param record    the result of the case or its summary
/// @param packings  at least one; they have the same number of points in all cycles, and count with the
/// cycles that all of them have
/// @param at        where the points of a curve are; empty for a number
store::ObservedCase observe_case(store::CaseRecord const& record,
                                 std::vector<ObservedPacking> const& packings, std::vector<double> const& at);

}  // namespace vibrotrough::evaluate
