#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace vibrotrough::core {

/// What a case or a packing can come to. outcome_table() says what each one means.
enum class Outcome {
    finished,
    not_precise,
    not_steady,
    bistable_or_slow,
    lost_grains,
    mesh_left_domain,
    insertion_incomplete,
    not_settled,
    overfull,
    diverged,
    wrong_weight,
    engine_error,
    engine_crashed,
    outputs_incomplete,
    out_of_memory,
    disk_full,
    time_limit,
    interrupted,
};

/// Whether the same run may end differently when it is repeated.
enum class Retry {
    useless,    ///< the same input ends in the same way
    sensible,   ///< the cause lies outside the run and may be gone
    after_cure  ///< once somebody has done what `cure` says
};

/// One row of the table of outcomes, from which the code, the messages and the documentation follow.
struct OutcomeEntry {
    Outcome outcome;           ///< the outcome that the row describes
    std::string_view name;     ///< in files, tables and messages
    std::string_view meaning;  ///< one sentence for the user
    Retry retry;               ///< whether a repetition may end differently
    std::string_view cure;     ///< what helps; empty when nothing is wrong or only a retry helps
};

/// All outcomes, in the order of the enumeration.
std::span<OutcomeEntry const> outcome_table();

/// The outcome's name, for example "lost-grains".
std::string_view name_of(Outcome outcome);

/// The outcome with this name; none for any other text.
std::optional<Outcome> outcome_named(std::string_view name);

/// Whether a case that ended so has a result: finished, not-precise, not-steady or bistable-or-slow.
bool has_result(Outcome outcome);

/// Whether such a result has a mean: finished or not-precise.
bool has_mean(Outcome outcome);

/// Whether [run] retries applies to this outcome.
bool retry_makes_sense(Outcome outcome);

/// In words: whether to try again, and what helps; empty when there is nothing to say.
std::string retry_advice(Outcome outcome);

/// The table in Markdown, as the documentation shows it.
std::string outcome_reference();

}  // namespace vibrotrough::core
