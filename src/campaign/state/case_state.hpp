#pragma once

#include "campaign/packing_outputs.hpp"
#include "campaign/state/plan.hpp"
#include "deck/deck.hpp"
#include "store/case_record.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// What is known about a case, told from its files alone.
enum class CaseState {
    finished,  ///< result.h5 is whole
    failed,    ///< failure.json names why
    started,   ///< some packing was begun
    open,      ///< nothing was done yet
};

std::string to_string(CaseState state);

/// Why a case has no result.
struct Failure {
    std::string outcome;  ///< name, e.g. "lost-grains"
    std::string message;
    int packing;
    int attempts;  ///< how often the case has failed so far
};

std::optional<Failure> read_failure(PlannedCase const& planned);
void write_failure(PlannedCase const& planned, Failure const& failure);

/// The case's result if result.h5 is there and whole; a damaged file counts as none.
std::optional<store::CaseRecord> read_whole_result(PlannedCase const& planned);

CaseState case_state(PlannedCase const& planned);

/// A packing whose engine ended well, as its folder holds it: deck, cycles.csv, packing.json.
struct FinishedPacking {
    double wall_time;                                              ///< s
    std::string started, finished;                                 ///< ISO 8601, UTC
    std::string program_version = "", git_commit = "", host = "";  ///< that ran it
    std::string engine_certificate = "";                           ///< JSON; empty when it was not probed
};

/// The packing's marker, if it is there and cycles.csv is still what it was then.
std::optional<FinishedPacking> read_finished_packing(PlannedCase const& planned, int packing);

/// The same when the packing's outputs were read already.
std::optional<FinishedPacking> read_finished_packing(PlannedCase const& planned, int packing,
                                                     PackingOutputs const& outputs);

/// Writes the marker packing.json: from now on the packing is not run again.
void write_finished_packing(PlannedCase const& planned, int packing, FinishedPacking const& finished,
                            PackingOutputs const& outputs);

/// Number of packings with a marker.
int count_finished_packings(PlannedCase const& planned);

}  // namespace vibrotrough::campaign
