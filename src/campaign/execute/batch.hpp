#pragma once

#include "campaign/execute/slurm.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// One packing of one case: the unit that runs anywhere.
struct Task {
    std::string case_id;
    int packing;
    auto operator<=>(Task const&) const = default;
};

/// One job array as its folder DIR/slurm/<number> holds it:
///   tasks.txt               a line "<case id> <packing>" per task, the index from 0
///   job.sh                  what every task runs
///   batch.json              the job's name, written before it is submitted, and its id, written after
///   task-<index>.started    written by the job script, atomically
///   task-<index>.ended      the same: the exit code of `vibrotrough work`
///   task-<index>.lost       written by whoever saw in Slurm that the task died without its last word
///   task-<index>.out        what the task printed
struct Batch {
    std::filesystem::path folder;
    std::string name;
    std::optional<long> job;
    std::vector<Task> tasks;
};

/// Reads the line of a task list. @throws InputError when there is no such line
Task read_task(std::filesystem::path const& task_list, int index);

/// All batches of a campaign, oldest first; damaged ones are left out.
std::vector<Batch> read_batches(std::filesystem::path const& campaign_folder);

/// What the job script of a batch must know.
struct Job {
    std::filesystem::path program;     ///< vibrotrough itself
    int ranks;                         ///< MPI ranks of the engine
    std::optional<double> time_limit;  ///< s, for the packing
    int retries;
};

/// Makes a batch's folder with its task list and job script; not yet submitted.
/// @throws MissingError when the disk refuses
Batch write_batch(std::filesystem::path const& campaign_folder, std::vector<Task> const& tasks,
                  Job const& job);

/// Remembers the batch's job id. @throws MissingError when the disk refuses
void remember_job(Batch& batch, long job);

/// Where a task stands.
enum class TaskState {
    waiting,  ///< in Slurm's queue
    running,
    ended,    ///< its script came to its end, or Slurm says that it died
    unknown,  ///< Slurm does not answer: it may be anything
};

struct TaskStatus {
    Task task;
    TaskState state;
    std::string outcome;  ///< of a task that died without its last word: "time-limit", "out-of-memory" or
                          ///< "interrupted"; else empty
    std::string message;
};

/// Where the tasks of all batches stand, the newest word on each (case, packing): the script's own markers
/// first, then squeue, then sacct; a task that nobody knows is lost. What Slurm says of a dead task is kept
/// in its marker, because Slurm forgets.
std::vector<TaskStatus> look_at_tasks(std::vector<Batch>& batches);

}  // namespace vibrotrough::campaign
