#include "engine/outcome.hpp"

#include "core/text.hpp"
#include "deck/deck.hpp"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include <fmt/format.h>

namespace vibrotrough::engine {
namespace {

/// Messages of the engine can hold garbage bytes.
std::string clean(std::string const& text) {
    return core::printable(text, 300);
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
    std::ifstream file(path);
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

/// What the deck says after its failure marker: " <name>: <message>".
RunReport named_failure(std::string const& text) {
    std::string const named = text.substr(std::min(text.find_first_not_of(' '), text.size()));
    if (named.empty()) return {Outcome::engine_error, "the deck gave up without saying why"};
    for (Outcome const outcome : {Outcome::insertion_incomplete, Outcome::not_settled}) {
        std::string const prefix = to_string(outcome) + ": ";
        if (named.starts_with(prefix)) return {outcome, named.substr(prefix.size())};
    }
    return {Outcome::engine_error, named};
}

}  // namespace

std::string to_string(Outcome outcome) {
    switch (outcome) {
        case Outcome::completed:
            return "completed";
        case Outcome::insertion_incomplete:
            return "insertion-incomplete";
        case Outcome::not_settled:
            return "not-settled";
        case Outcome::mesh_left_domain:
            return "mesh-left-domain";
        case Outcome::lost_grains:
            return "lost-grains";
        case Outcome::engine_error:
            return "engine-error";
        case Outcome::engine_crashed:
            return "engine-crashed";
        case Outcome::outputs_incomplete:
            return "outputs-incomplete";
    }
    return "unknown";
}

RunReport examine_run(std::filesystem::path const& folder, ExitStatus status, Stage stage) {
    Transcript const seen = read_transcript(folder / output_file);
    if (seen.failure) return named_failure(*seen.failure);
    if (seen.error) {
        bool const lost = seen.error->find("Lost atoms") != std::string::npos;
        return {lost ? Outcome::lost_grains : Outcome::engine_error, *seen.error};
    }
    // After an error message MPI_Abort may end the engine by a signal: the message is the reason.
    if (status.signal != 0) {
        return {Outcome::engine_crashed, fmt::format("the engine was killed by signal {} ({})", status.signal,
                                                     strsignal(status.signal))};
    }
    if (status.code != 0) {
        return {Outcome::engine_error,
                fmt::format("the engine ended with exit code {} and no message", status.code)};
    }
    if (seen.caught_signal) return {Outcome::engine_crashed, "the engine was told to stop by a signal"};
    if (seen.mesh_outside) {
        return {Outcome::mesh_left_domain,
                "the trough's mesh reaches over the box, where it meets its own image"};
    }
    if (!(stage == Stage::settling ? seen.settled : seen.ended)) {
        return {Outcome::outputs_incomplete,
                "the engine ended with exit code 0 but without its end marker; is the disk full?"};
    }
    return {Outcome::completed, {}, seen.last_step, -seen.settled_force};
}

}  // namespace vibrotrough::engine
