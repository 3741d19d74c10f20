#pragma once

#include "campaign/execute/executor.hpp"
#include "campaign/state/foreign_commands.hpp"
#include "engine/engine.hpp"
#include "scenario/model/run_settings.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
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
    double speed = 0;  ///< grain-steps per second of one core, expected; needed for task_duration
    std::filesystem::path task_list = {};  ///< the file that the executor "task-list" writes
};

/// What the accounting of a scheduler has counted for a campaign.
struct CountedTime {
    std::string_view name, title;     ///< of the scheduler: its word, and in messages
    std::optional<double> core_time;  ///< s, Scheduler::count_core_time(); none where nothing is counted
    std::vector<long> missing = {};   ///< jobs that were submitted and that the accounting does not know
};

/// One kind of executor. The table of all kinds is the only place that knows them.
struct ExecutorKind {
    std::string_view name;   ///< the word of run.executor in the campaign file
    std::string_view title;  ///< in messages
    std::unique_ptr<Executor> (*make)(ExecutorInputs const& inputs);  ///< makes an executor of this kind
    /// What this kind still knows of packings of a campaign's folder; nothing where it leaves no traces.
    std::vector<PackingActivity> (*activity)(std::filesystem::path const& campaign_folder);
    /// What a site has counted for it; nothing where this kind has submitted nothing.
    std::optional<CountedTime> (*counted)(std::filesystem::path const& campaign_folder) =
        [](std::filesystem::path const&) { return std::optional<CountedTime>(); };
};

/// All kinds of executors.
std::span<ExecutorKind const> executor_kinds();

/// The kind that the campaign file asks for.
/// @throws std::out_of_range when there is no such kind, which the reader of campaign files has excluded
ExecutorKind const& executor_kind(std::string_view name);

/// What all kinds know of a campaign, and whether a program on this machine drives it now.
Activity activity_in(std::filesystem::path const& campaign_folder);

/// Refuses to run a campaign with one kind of executor while another still holds packings of it.
/// @throws core::MissingError
void refuse_other_executors(std::filesystem::path const& campaign_folder, ExecutorKind const& wanted);

}  // namespace vibrotrough::campaign
