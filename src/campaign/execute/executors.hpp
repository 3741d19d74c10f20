#pragma once

#include "campaign/execute/executor.hpp"
#include "campaign/state/foreign_commands.hpp"
#include "engine/engine.hpp"
#include "scenario/model/run_settings.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace vibrotrough::campaign {

/// What an executor may need to know. Must outlive the executor.
struct ExecutorInputs {
    std::filesystem::path campaign_folder;  ///< of the campaign's results
    engine::Engine engine;                  ///< that simulates
    scenario::RunSettings settings;         ///< of [run] in the campaign file
    int cores = 1;                          ///< of this machine that may be used
    std::filesystem::path
        program;  ///< the program whose `work` command runs a packing, as compute nodes see it
    ForeignCommands foreign_commands = {};     ///< which of them the engine may run
    std::optional<double> task_duration = {};  ///< s, that a task of a cluster should take; none: one packing
    double speed = 0;         ///< grain-steps per second of one core, expected; needed for task_duration
    bool holds_lock = false;  ///< whoever runs the packings has locked them already
    std::filesystem::path task_list = {};  ///< the file that the executor "task-list" writes
    bool is_learning = false;              ///< the driver's policy has the half-widths of learn.json
};

/// One kind of executor.
struct ExecutorKind {
    std::string_view name;  ///< the word of run.executor in the campaign file
    std::unique_ptr<Executor> (*make)(ExecutorInputs const& inputs);  ///< makes an executor of this kind
};

/// Runs packings on the cores of this machine, in the order given, each with its engine as a process of its
/// own. When the process ends, the engines end.
std::unique_ptr<Executor> make_local_executor(ExecutorInputs const& inputs);

/// Runs packings as tasks of Slurm's job arrays. They go on when this process ends.
std::unique_ptr<Executor> make_batch_executor(ExecutorInputs const& inputs);

/// Writes the packings into a task list for another scheduler, ExecutorInputs::task_list, and the decks of
/// their cases; it runs nothing. `vibrotrough work` runs a line of the list. Packings that such a process
/// simulates now are left out.
std::unique_ptr<Executor> make_task_list_executor(ExecutorInputs const& inputs);

/// The kind that the campaign file asks for.
/// @throws std::out_of_range when there is no such kind, which the reader of campaign files has excluded
ExecutorKind const& executor_kind(std::string_view name);

/// What Slurm knows of a campaign, and whether a program on this machine drives it now.
Activity activity_in(std::filesystem::path const& campaign_folder);

/// Refuses to run a campaign with another executor while Slurm still holds packings of it.
/// @throws core::MissingError
void refuse_other_executors(std::filesystem::path const& campaign_folder, ExecutorKind const& wanted);

}  // namespace vibrotrough::campaign
