#pragma once

#include "core/outcome.hpp"
#include "evaluate/packing_files.hpp"
#include "measure/cycle_series.hpp"
#include "measure/estimate.hpp"
#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace vibrotrough::evaluate {

/// A packing with all that was measured in it, and how it was run.
struct EvaluatedPacking {
    PackingMarker run;            ///< how it was run
    store::PackingRecord record;  ///< what was measured
};

/// Packings of one case by number, from 1.
using EvaluatedPackings = std::map<int, EvaluatedPacking>;

/// The estimate of a packing's velocity efficiency from the cycles written so far.
struct InterimEstimate {
    int cycles;                                        ///< written
    std::optional<measure::PackingEstimate> estimate;  ///< none before the second cycle
};

/// The cycles of a packing whose run has ended.
struct FinishedCycles {
    std::vector<double> efficiency;  ///< velocity efficiency of each cycle
    double core_time;                ///< s, see PackingMarker
};

/// Reads the cycles of a packing that is being simulated.
/// @throws core::InputError when cycles.csv is damaged, core::MissingError when there is none
InterimEstimate estimate_so_far(prepare::PreparedCase const& prepared,
                                std::filesystem::path const& packing_folder);

/// The cycles of a finished packing; none when it is not finished or damaged.
std::optional<FinishedCycles> read_finished_cycles(prepare::PreparedCase const& prepared,
                                                   std::filesystem::path const& packing_folder);

/// The velocity efficiency of the first cycles of a packing, whatever became of its run.
/// @throws core::InputError when cycles.csv is damaged or has fewer cycles, core::MissingError when there is
/// none
std::vector<double> read_efficiency(prepare::PreparedCase const& prepared,
                                    std::filesystem::path const& packing_folder, int cycles);

/// Why the outputs of a run cannot be used.
struct UnusableOutputs {
    core::Outcome outcome;  ///< what the packing comes to
    std::string message;    ///< one line for people
};

/// Evaluates a packing whose engine ended normally: checks that all cycles and phases are there, that every
/// number is finite, that displacements and velocities say the same, and that the trough carried the layer's
/// weight, and measures everything that the case's result will need.
/// @param packing    its number, from 1
/// @param last_step  of the engine
/// @return the record without wall time and deck, which only the caller knows, or why there is none
std::variant<store::PackingRecord, UnusableOutputs> evaluate_outputs(prepare::PreparedCase const& prepared,
                                                                     int packing, PackingFiles const& files,
                                                                     long last_step);

/// A finished packing from its folder; none when it is not finished.
/// @param cycles  of the run that are used; the others are left out
/// @throws core::InputError when its files are damaged or it has fewer cycles, core::MissingError when some
/// are missing
std::optional<EvaluatedPacking> read_packing(prepare::PreparedCase const& prepared, int packing,
                                             std::filesystem::path const& packing_folder, int cycles);

/// Copies how a packing was run into its record.
void add_run(store::PackingRecord& record, PackingMarker const& marker);

/// How far an unfinished or failed run has come.
struct RunExtent {
    int cycles = 0;         ///< written completely
    bool diverged = false;  ///< a number is NaN or infinite, or the layer is faster than 100 times the trough
};

/// Reads cycles.csv as far as it is readable.
RunExtent extent_of_run(prepare::PreparedCase const& prepared, std::filesystem::path const& packing_folder);

}  // namespace vibrotrough::evaluate
