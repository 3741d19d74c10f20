#pragma once

#include "campaign/execute/slurm.hpp"
#include "campaign/execute/task_list.hpp"
#include "campaign/state/overview.hpp"
#include "campaign/state/plan.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// One job array as its folder DIR/slurm/NUMBER holds it:
///   tasks.txt           a line per task, the index from 0: "<case id> <packing>" for each of its packings
///   job.sh              what every task runs
///   batch.json          the job's name, written before it is submitted, and its id, written afterwards
///   task-INDEX.started  written by the job script, atomically
///   task-INDEX.ended    the same: the exit code of `vibrotrough work`
///   task-INDEX.out      what the task printed
struct Batch {
    std::filesystem::path folder;  ///< DIR/slurm/NUMBER
    std::string name;              ///< the job's name
    std::optional<long> job;       ///< the job's id; none before it was submitted
    std::vector<Task> tasks;       ///< by index
};

/// All batches of a campaign that Slurm was given, oldest first; damaged ones are left out.
std::vector<Batch> read_batches(std::filesystem::path const& campaign_folder);

/// What the job script of a batch must know.
struct JobScript {
    std::filesystem::path program;     ///< vibrotrough itself
    int ranks;                         ///< MPI ranks of the engine
    std::optional<double> time_limit;  ///< s, for the packing
    int retries;                       ///< of a packing, after a failure that may not happen again
    bool allow_extra;                  ///< the engine may run the commands of the campaign's files
    std::vector<std::string> setup;    ///< lines of bash that run first
    int engines = 1;                   ///< that run at the same time
    bool is_warned = false;            ///< Slurm sends SIGUSR1 before the end, and the task is queued again
    bool is_learning = false;          ///< packings are wanted for the half-widths of learn.json
};

/// Makes a batch's folder with its task list and job script; not yet submitted.
/// @throws MissingError when the disk refuses
Batch write_batch(std::filesystem::path const& campaign_folder, std::vector<Task> const& tasks,
                  JobScript const& script);

/// Remembers the batch's job id. @throws MissingError when the disk refuses
void remember_job(Batch& batch, long job);

/// What is known of one task of a batch.
struct TaskActivity {
    PackingActivity::State state = PackingActivity::unknown;  ///< where it stands, and each of its packings
    std::optional<core::Outcome> outcome = {};                ///< of a task that ended without a word
    std::string message = {};                                 ///< one line for people
};

/// What became of the tasks of all batches, by batch and index: the job script's own markers first, then what
/// Slurm knows; a task that neither knows is lost.
std::vector<std::vector<TaskActivity>> survey_tasks(std::vector<Batch>& batches);

/// The same for the packings of a campaign: the newest task of each counts. Writes nothing.
std::vector<PackingActivity> survey_packings(std::filesystem::path const& campaign_folder);

}  // namespace vibrotrough::campaign
