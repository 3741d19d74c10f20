#pragma once

#include "engine/engine.hpp"

#include <filesystem>
#include <string>

namespace vibrotrough::engine {

/// How a run of the engine ended, by name.
enum class Outcome {
    completed,             ///< exit code 0, the deck's end marker, nothing said against it
    insertion_incomplete,  ///< not all grains found room
    not_settled,           ///< the packing did not come to rest
    mesh_left_domain,      ///< the trough's mesh reaches over the box
    lost_grains,           ///< grains left the box
    engine_error,          ///< the engine stopped with an error message
    engine_crashed,        ///< the engine was killed by a signal
    outputs_incomplete,    ///< the engine ended without what it should have written (often a full disk)
};

/// Which of the two decks was run.
enum class Stage {
    settling,  ///< ends with the settled marker
    driving,   ///< ends with the end marker
};

/// How a run of the engine ended, and what it reported at its end.
struct RunReport {
    Outcome outcome;           ///< by name
    std::string message;       ///< one line for people; empty when completed
    long last_step = 0;        ///< of the end marker, of driving
    double settled_force = 0;  ///< N, of the resting layer on the trough, pressing positive, of settling
};

/// "completed", "insertion-incomplete", ...
std::string to_string(Outcome outcome);

/// Judges an ended run by its exit status and what it printed into `folder`. An exit code alone proves
/// nothing: LIGGGHTS also ends with 0 after a signal and on a full disk.
RunReport examine_run(std::filesystem::path const& folder, ExitStatus status, Stage stage);

}  // namespace vibrotrough::engine
