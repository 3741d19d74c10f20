#pragma once

#include "core/outcome.hpp"
#include "scenario/model/run_settings.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// @file
/// The commands of Slurm. Another scheduler has these three functions too.

namespace vibrotrough::campaign {

/// A job array to submit. The job script is `files`/job.sh, and what task N prints belongs into
/// `files`/task-N.out.
struct JobArray {
    std::filesystem::path folder;      ///< working directory of the tasks: the campaign's folder, absolute
    std::string files;                 ///< folder of the batch, below `folder`
    std::string name;                  ///< of the job, unique
    int tasks;                         ///< indices 0 ... tasks - 1
    int cores;                         ///< of each task, each for one MPI rank of an engine
    scenario::BatchSettings settings;  ///< what is asked of Slurm for every task
};

/// What Slurm made of an array. Nothing was submitted when there is no job: there is no room now, or, with
/// `most_tasks`, the array is too large for this site.
struct Submission {
    std::optional<long> job = {};        ///< Slurm's id
    std::optional<int> most_tasks = {};  ///< that one array may have here; fewer than it has
};

/// An array that was submitted, or that may have been.
struct SubmittedArray {
    std::string name;         ///< of the job
    std::optional<long> job;  ///< its id; none when the driver died before it wrote the id down
};

/// What Slurm knows of one task.
struct TaskReport {
    /// Where the task stands.
    enum State { waiting, running, ended };
    State state;  ///< where it stands
    /// For a task that ended, why it did so, as far as Slurm knows.
    core::Outcome outcome = core::Outcome::interrupted;
    std::string message = {};  ///< one line for people; may be empty while the task has not ended
};

/// By the job's name and the index of the task.
using TaskReports = std::map<std::pair<std::string, int>, TaskReport>;

/// Submits an array, after asking whether it could ever start: Slurm also takes jobs that wait for ever.
/// @throws core::MissingError with Slurm's own words when it refuses, or is not there
Submission submit_to_slurm(JobArray const& array);

/// What is known of the arrays' tasks, with as few calls as possible. A task that is missing from the answer
/// is unknown to Slurm. Looks for arrays without an id by their name, and adds the id.
/// @return nothing when Slurm does not answer: then nothing must be concluded
/// @throws core::MissingError when there is no Slurm here
std::optional<TaskReports> ask_slurm(std::vector<SubmittedArray>& arrays);

/// Takes tasks of an array out of the queue. A task that has started meanwhile may go on.
void cancel_in_slurm(SubmittedArray const& array, std::vector<int> const& tasks);

}  // namespace vibrotrough::campaign
