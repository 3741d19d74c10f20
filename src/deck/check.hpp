#pragma once

#include "prepare/prepared_case.hpp"

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace vibrotrough::deck {

/// How serious a finding is.
enum class Severity {
    fine,     ///< within its limit
    warning,  ///< the result may be inaccurate or take long to compute
    error,    ///< the result will be useless
};

/// One property of a case that can be checked before anything is simulated.
struct Finding {
    Severity severity;   ///< from `measured` and the limits
    std::string item;    ///< what was checked, in words, e.g. "periodic length / diameter"
    std::string key;     ///< the key of the campaign file that changes it most directly
    double measured;     ///< its value, in `unit`
    std::string unit;    ///< "1" for pure numbers
    bool at_least;       ///< whether the limits are lower limits
    double limit;        ///< beyond it, the finding is a warning
    double hard_limit;   ///< beyond it, the finding is an error; infinite, or 0 for a lower limit, if never
    std::string advice;  ///< what to change
};

/// Largest ratio of large to small diameters at which LIGGGHTS 3.8.0 was seen to move a small grain between
/// two large ones as it should (engine/README.md).
constexpr double largest_tried_size_ratio = 20;

/// A limit beyond which nothing is.
inline constexpr double never = std::numeric_limits<double>::infinity();

/// A finding whose limits are upper limits.
inline Finding most(std::string item, std::string key, double measured, double limit, double hard_limit,
                    std::string advice) {
    Severity const severity = measured > hard_limit ? Severity::error
                              : measured > limit    ? Severity::warning
                                                    : Severity::fine;
    return {severity, std::move(item), std::move(key), measured,         "1",
            false,    limit,           hard_limit,     std::move(advice)};
}

/// A finding whose limits are lower limits.
inline Finding least(std::string item, std::string key, double measured, double limit, double hard_limit,
                     std::string advice) {
    Severity const severity = measured < hard_limit           ? Severity::error
                              : measured < limit * (1 - 1e-9) ? Severity::warning
                                                              : Severity::fine;
    return {severity, std::move(item), std::move(key), measured,         "1",
            true,     limit,           hard_limit,     std::move(advice)};
}

/// How far a finding is beyond its limit (above 1) or within it.
double excess(Finding const& finding);

/// "fine", "warning" or "error".
std::string to_string(Severity severity);

/// Checks what a careful person would check before spending hours of computing on a case: time step, steps
/// per cycle and per contact, overlaps, contact time against flight time, the box, the errors that
/// are known of such settings, the sizes of the grains, neighbour lists, disk space. Each stage of a drive is
/// checked as if it had no end, and the worst of each finding counts. All findings are
/// returned, including fine ones, in a fixed order. The formulas are in `estimates.hpp`.
std::vector<Finding> check(prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::deck
