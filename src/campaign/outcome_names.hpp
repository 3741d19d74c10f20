#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vibrotrough::campaign {

/// Whether the same run may end otherwise when it is tried again.
enum class Retry {
    useless,       ///< the same input ends the same way
    sensible,      ///< the cause lies outside the run and may be gone
    after_mending  ///< once somebody has done what the advice says
};

/// What a case or a packing can come to.
struct OutcomeName {
    std::string_view name;
    std::string_view meaning;
    Retry retry;
    std::string_view advice;  ///< what helps; empty when nothing is wrong
};

/// All outcomes, in the order of the README.
std::span<OutcomeName const> outcome_names();

/// The outcome with this name, or nullptr.
OutcomeName const* find_outcome(std::string_view name);

/// Whether [run] retries applies to this outcome.
bool retry_makes_sense(std::string_view name);

/// In words: whether to try again, and what helps.
std::string retry_advice(std::string_view name);

/// The outcomes as a Markdown table, as it stands in README.md.
std::string outcome_reference();

}  // namespace vibrotrough::campaign
