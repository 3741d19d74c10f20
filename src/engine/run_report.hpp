#pragma once

#include "core/outcome.hpp"
#include "engine/engine.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace vibrotrough::engine {

/// Which of the two decks was run.
enum class Stage {
    settling,  ///< ends with the settled marker
    driving,   ///< ends with the end marker
};

/// How a run of the engine ended.
struct RunReport {
    /// Why the run failed; none when it completed: exit code 0, the deck's end marker, and no complaint.
    std::optional<core::Outcome> failure;
    std::string message;       ///< one line for people; empty when the run completed
    int signal = 0;            ///< that killed the engine; 0 when none did
    long last_step = 0;        ///< of the end marker, of driving
    double settled_force = 0;  ///< N, of the resting layer on the trough, pressing positive, of settling
};

/// What an engine or a probe wrote into a file; nothing when there is no such file, or when something else
/// than a file has its name. What should be in it is then missing.
std::string text_of_output(std::filesystem::path const& path);

/// Judges an ended run by its exit status and what it printed into `folder`. An exit code alone proves
/// nothing: LIGGGHTS also ends with 0 after a signal and on a full disk.
RunReport examine_run(std::filesystem::path const& folder, ExitStatus status, Stage stage);

}  // namespace vibrotrough::engine
