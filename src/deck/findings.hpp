#pragma once

#include "deck/check.hpp"

#include <limits>
#include <string>
#include <utility>

/// @file
/// Findings from numbers and their limits.

namespace vibrotrough::deck {

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

}  // namespace vibrotrough::deck
