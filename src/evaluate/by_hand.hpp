#pragma once

#include "core/outcome.hpp"
#include "measure/case_estimate.hpp"
#include "prepare/prepared_case.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// Runs that a person made by hand from a deck of 'vibrotrough deck', changed or not.
namespace vibrotrough::evaluate {

/// One packing that was run by hand.
struct HandPacking {
    std::filesystem::path folder;  ///< of the run
    int number;                    ///< N of a folder packing-N, else 1
    int cycles = 0;  ///< whole cycles that were written, but no more than planned of a given length
    std::vector<double> efficiency = {};  ///< velocity efficiency of each cycle
    std::string end;                      ///< how the run ended, in words
    std::string mode = {};                ///< of the layer; empty when it is not known
    /// Why the run would not count in a campaign; none when it would.
    std::optional<core::Outcome> fault = {};
    std::string message = {};  ///< one line about the fault
};

/// What was measured in a folder.
struct HandRun {
    std::filesystem::path scenario_file;  ///< that was read
    prepare::PreparedCase prepared;       ///< the case as its scenario says, with the drive that was run
    std::vector<HandPacking> packings;    ///< by number
    int cycles_used;                      ///< of every packing: as many as the shortest has
    measure::CaseEstimate estimate;       ///< of the velocity efficiency
    core::Outcome outcome;                ///< the first fault, else what the estimate says
    /// In what the deck was seen to differ from the scenario, a sentence each.
    std::vector<std::string> changes = {};
    bool has_known_contact = true;  ///< the deck's contact is the scenario's, of which the errors are known
};

/// Measures the run in a folder that has a cycles.csv, or all runs in the folders packing-N of a case.
/// Nothing is written. Numbers are scaled with the drive that was run: amplitude and angle are those of the
/// trough in phases.csv, the frequency follows from the deck's time step and steps per cycle. Drives in
/// stages are those of the scenario.
/// @param scenario_file  empty: scenario.toml in the folder, or in the one above
/// @throws core::InputError when a file is missing or damaged, or there is no whole cycle
HandRun measure_by_hand(std::filesystem::path const& folder, std::filesystem::path const& scenario_file = {});

}  // namespace vibrotrough::evaluate
