#pragma once

#include "campaign/execute/scheduler.hpp"
#include "core/error.hpp"

#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::campaign {

/// What a scheduler's command answered.
struct CallAnswer {
    int code;            ///< exit code
    std::string output;  ///< its standard output
    std::string errors;  ///< its standard error

    /// Whether its standard error contains one of the texts.
    bool complains_of(std::vector<std::string_view> const& texts) const;
    /// Its first line of errors or, where it has none, of output, made printable.
    std::string words() const;
};

/// Whether there is such a command here.
bool has_command(std::string const& name);

/// Runs a command of a scheduler to its end, a minute at most. No shell reads the words.
/// @param title   of the scheduler, for the message
/// @throws core::MissingError when there is no such command here
CallAnswer call_scheduler(std::string_view title, std::vector<std::string> words);

/// The same for a question that must be answered.
/// @throws core::MissingError when the command fails, because the scheduler does not answer
CallAnswer call_or_throw(std::string_view title, std::vector<std::string> words);

/// The error that a scheduler does not take a job, with its own words.
/// @param see  what can be read about it
core::MissingError refusal(std::string_view title, CallAnswer const& answer, std::string_view see);

/// The lines of a table, split at the separator, without the spaces at the ends of the parts.
std::vector<std::vector<std::string>> rows_of(std::string const& table, char separator);

/// The whole text as a number; nothing when it is not one.
template <typename Number>
std::optional<Number> number_in(std::string_view text) {
    Number number{};
    auto const [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc() || end != text.data() + text.size()) return {};
    return number;
}

/// Refuses what would wait for ever.
/// @param limit  of `place`: "[days-][[hours:]minutes:]seconds"; any other text means that there is none
/// @throws core::MissingError when more time is asked for
void check_time_limit(std::string_view section, std::string_view place, std::string const& limit,
                      scenario::BatchSettings const& asked);

/// Adds the ids of arrays that have none, as far as the scheduler knows a job of their name.
/// @return the names by id
std::map<long, std::string> name_by_id(std::vector<SubmittedArray>& arrays,
                                       std::optional<long> (*find_by_name)(std::string const& name));

/// The ids with commas between them.
std::string ids_of(std::map<long, std::string> const& name_by_id);

}  // namespace vibrotrough::campaign
