#pragma once

#include "campaign/state/checkpoint.hpp"
#include "core/note.hpp"
#include "core/outcome.hpp"
#include "evaluate/friction_test.hpp"
#include "store/observable.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::campaign {

// The notes in a campaign's folder, from their text alone. All functions throw core::note::Fault when the
// text is not such a note, and numbers are in the range that they can have.

/// Why a case has no result.
struct Failure {
    core::Outcome outcome;  ///< what the case came to
    std::string message;    ///< one line for people
    int packing;            ///< that failed, from 1
    int attempts;           ///< how often the case has failed so far
};

/// failure.json
Failure parse_failure(std::string_view text);

/// What checkpoint.json says, which has to be compared with the files that it seals.
struct CheckpointSeal {
    Checkpoint checkpoint;       ///< that is sealed
    std::string restart_sha256;  ///< of the restart file
    std::string deck_sha256;     ///< of the deck that wrote it
};

/// checkpoint.json
CheckpointSeal parse_checkpoint(std::string_view text);

/// settled.json. @returns the SHA-256 of the restart file of a settled packing
std::string parse_settled(std::string_view text);

/// A job array as its batch.json describes it.
struct BatchNote {
    std::string name;         ///< of the job, as this program gives it
    std::optional<long> job;  ///< id, > 0; none while the scheduler has not told it
};

/// batch.json
BatchNote parse_batch(std::string_view text);

/// The engine of a campaign, and what is frozen in the campaign's folder.
struct EngineNote {
    std::string program;                 ///< its path
    std::string version;                 ///< as the engine says it
    std::string binary_sha256;           ///< empty when it is not known
    std::vector<std::string> templates;  ///< names of the deck's templates; empty: the program's own
};

/// engine.json
EngineNote parse_engine(std::string_view text);
/// The text of engine.json.
std::string to_json(EngineNote const& note);

/// friction.json. @returns by layer, the tests that have a number
std::map<std::string, evaluate::LayerFriction> parse_friction(std::string_view text);

/// numerics.json. @returns its list of cases, in each of which "case" and "numerical_error" are sound
core::note::Json parse_numerics(std::string_view text);

constexpr char const* numerics_format = "vibrotrough numerics";  ///< the format that numerics.json names
constexpr int numerics_schema = 1;                               ///< its schema version

/// observables.json
std::vector<store::Observable> parse_observables(std::string_view text);
/// The text of observables.json.
std::string to_json(std::vector<store::Observable> const& observables);

}  // namespace vibrotrough::campaign
