#pragma once

#include "campaign/execute/scheduler.hpp"
#include "campaign/execute/task_list.hpp"
#include "campaign/state/overview.hpp"
#include "campaign/state/plan.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// One job array as its folder DIR/SCHEDULER/NUMBER holds it:
///   tasks.txt           a line per task, the index from 0: "<case id> <packing>" for each of its packings
///   job.sh              what every task runs
///   batch.json          the job's name, written before it is submitted, and its id, written afterwards
///   task-INDEX.started  written by the job script, atomically
///   task-INDEX.ended    the same: the exit code of `vibrotrough work`
///   task-INDEX.lost     written by `run` when the scheduler reports that the task ended without an exit
///                       marker
///   task-INDEX.out      what the task printed
struct Batch {
    std::filesystem::path folder;  ///< DIR/SCHEDULER/NUMBER
    std::string name;              ///< the job's name
    std::optional<long> job;       ///< the job's id; none before it was submitted
    std::vector<Task> tasks;       ///< by index
};

/// All batches of a campaign that a scheduler was given, oldest first; damaged ones are left out.
std::vector<Batch> read_batches(Scheduler const& scheduler, std::filesystem::path const& campaign_folder);

/// What the job script of a batch must know.
struct JobScript {
    std::filesystem::path program;     ///< vibrotrough itself
    int ranks;                         ///< MPI ranks of the engine
    std::optional<double> time_limit;  ///< s, for the packing
    int retries;                       ///< of a packing, after a failure that may not happen again
    bool allow_extra;                  ///< the engine may run the commands of the campaign's files
    std::vector<std::string> setup;    ///< lines of bash that run first
    int engines = 1;                   ///< that run at the same time
    bool is_warned = false;  ///< the scheduler sends SIGUSR1 before the end, and the task is queued again
};

/// Makes a batch's folder with its task list and job script; not yet submitted.
/// @throws MissingError when the disk refuses
Batch write_batch(Scheduler const& scheduler, std::filesystem::path const& campaign_folder,
                  std::vector<Task> const& tasks, JobScript const& script);

/// Remembers the batch's job id. @throws MissingError when the disk refuses
void remember_job(Batch& batch, long job);

/// What is known of one task of a batch.
struct TaskActivity {
    PackingActivity::State state = PackingActivity::unknown;  ///< where it stands, and each of its packings
    std::optional<core::Outcome> outcome = {};                ///< of a task that ended without a word
    std::string message = {};                                 ///< one line for people
};

/// What became of the tasks of all batches, by batch and index: the job script's own markers first, then what
/// the scheduler knows; a task that neither knows is lost.
std::vector<std::vector<TaskActivity>> survey_tasks(Scheduler const& scheduler, std::vector<Batch>& batches);

/// The same for packings: the newest task of each counts. What the scheduler reports of a task that died is
/// only known for a while; remember_lost_tasks() keeps it.
std::vector<PackingActivity> survey_packings(Scheduler const& scheduler, std::vector<Batch>& batches);

/// Writes what the scheduler reports of tasks that died without a marker into markers task-INDEX.lost,
/// because schedulers forget. A disk that refuses is ignored.
void remember_lost_tasks(Scheduler const& scheduler, std::vector<Batch>& batches);

}  // namespace vibrotrough::campaign
