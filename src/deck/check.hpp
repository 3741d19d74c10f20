#pragma once

#include "prepare/prepared_case.hpp"

#include <string>
#include <vector>

namespace vibrotrough::deck {

enum class Severity {
    fine,     ///< within its limit
    warning,  ///< the result may be off, or dear
    error,    ///< the result will be worthless
};

/// One thing that can be known before anything is simulated.
struct Finding {
    Severity severity;
    std::string item;    ///< what was looked at, in words, e.g. "overlap at impact / diameter"
    std::string key;     ///< the campaign file's key that changes it most directly
    double measured;     ///< in `unit`
    std::string unit;    ///< "1" for pure numbers
    bool at_least;       ///< whether `limit` is a lower one
    double limit;        ///< beyond it: a warning
    double hard_limit;   ///< beyond it: an error; infinite (or 0 for a lower one) when there is none
    std::string advice;  ///< what to change
};

/// "fine", "warning" or "error".
std::string to_string(Severity severity);

/// Looks at everything about a case that a person would look at before spending hours on it: time step, steps
/// per cycle and contact, overlaps, contact against flight time, the box, neighbour lists, disk. All items
/// are given, fine ones too, always in the same order. The formulas are in `estimates.hpp`.
std::vector<Finding> check(prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::deck
