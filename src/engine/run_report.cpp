#include "engine/run_report.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "deck/deck.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

namespace vibrotrough::engine {
namespace {

/// Bytes; an engine that writes more repeats itself.
constexpr std::size_t largest_output = std::size_t{256} << 20;

/// Messages of the engine can hold garbage bytes.
std::string clean(std::string const& text) {
    return core::harmless(text.substr(0, 300));
}

/// The lines of the engine's output that matter.
struct Transcript {
    std::optional<std::string> error;    ///< the first "ERROR" line
    std::optional<std::string> failure;  ///< what the deck says after its failure marker
    bool mesh_outside = false;
    bool caught_signal = false;
    bool settled = false;
    bool ended = false;
    long last_step = 0;
    double settled_force = 0;
};

std::optional<std::string> after(std::string const& line, char const* marker) {
    if (!line.starts_with(marker)) return {};
    return line.substr(std::strlen(marker));
}

Transcript read_transcript(std::filesystem::path const& path) {
    Transcript seen;
    std::istringstream file(text_of_output(path));
    bool begun_anew = false;
    for (std::string line, word; std::getline(file, line);) {
        if (!seen.error && line.starts_with("ERROR")) seen.error = clean(line);
        if (line.find("SIGINT/SIGTERM caught") != std::string::npos) seen.caught_signal = true;
        // A mesh that comes from a checkpoint is on the box faces up to rounding, and was there before.
        if (line.starts_with(deck::begin_marker)) begun_anew = !line.ends_with(" cycle 0");
        if (!begun_anew && line.find("Not all nodes of fix mesh inside simulation box") != std::string::npos)
            seen.mesh_outside = true;
        if (auto const text = after(line, deck::failure_marker)) seen.failure = clean(*text);
        if (auto const text = after(line, deck::settled_marker)) {
            seen.settled = static_cast<bool>(std::istringstream(*text) >> word >> seen.settled_force);
        }
        if (auto const text = after(line, deck::end_marker)) {
            seen.ended = static_cast<bool>(std::istringstream(*text) >> word >> seen.last_step);
        }
    }
    return seen;
}

/// What an error message of the engine means.
core::Outcome outcome_of_error(std::string const& message) {
    auto const speaks_of = [&](std::string_view words) { return message.find(words) != message.npos; };
    constexpr std::array<std::string_view, 5> memory{"Failed to allocate", "Failed to reallocate",
                                                     "bad_alloc", "Cannot allocate memory", "out of memory"};
    if (speaks_of("Lost atoms")) return core::Outcome::lost_grains;
    if (std::ranges::any_of(memory, speaks_of)) return core::Outcome::out_of_memory;
    return core::Outcome::engine_error;
}

/// What the deck says after its failure marker: " <name>: <message>".
RunReport named_failure(std::string const& text) {
    std::string const named = text.substr(std::min(text.find_first_not_of(' '), text.size()));
    if (named.empty()) return {core::Outcome::engine_error, "the deck stopped without giving a reason"};
    for (core::Outcome const outcome :
         {core::Outcome::insertion_incomplete, core::Outcome::not_settled, core::Outcome::overfull}) {
        std::string const prefix = std::string(name_of(outcome)) + ": ";
        if (named.starts_with(prefix)) return {outcome, named.substr(prefix.size())};
    }
    return {core::Outcome::engine_error, named};
}

}  // namespace

std::string text_of_output(std::filesystem::path const& path) {
    try {
        return core::read_file(path, largest_output);
    } catch (core::MissingError const&) {
        return {};
    }
}

RunReport examine_run(std::filesystem::path const& folder, ExitStatus status, Stage stage) {
    Transcript const seen = read_transcript(folder / output_file);
    if (seen.failure) return named_failure(*seen.failure);
    if (seen.error) {
        return {outcome_of_error(*seen.error), *seen.error};
    }
    // After an error message MPI_Abort may end the engine by a signal: the message is the reason.
    if (status.signal != 0) {
        return {
            core::Outcome::engine_crashed,
            fmt::format("the engine was killed by signal {} ({})", status.signal, strsignal(status.signal)),
            status.signal};
    }
    if (status.code != 0) {
        return {core::Outcome::engine_error,
                fmt::format("the engine ended with exit code {} and no message", status.code)};
    }
    if (seen.caught_signal) return {core::Outcome::engine_crashed, "the engine was told to stop by a signal"};
    if (seen.mesh_outside) {
        return {core::Outcome::mesh_left_domain,
                "the trough mesh extends outside the simulation box, where it would overlap its own image"};
    }
    if (!(stage == Stage::settling ? seen.settled : seen.ended)) {
        return {core::Outcome::outputs_incomplete,
                "the engine ended with exit code 0 but without its end marker; is the disk full?"};
    }
    return {{}, {}, 0, seen.last_step, -seen.settled_force};
}

}  // namespace vibrotrough::engine
