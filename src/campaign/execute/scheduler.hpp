#pragma once

#include "core/outcome.hpp"
#include "scenario/model/run_settings.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vibrotrough::campaign {

/// A job array to submit. The job script is `files`/job.sh, and what task N prints belongs into
/// `files`/task-N.out.
struct JobArray {
    std::filesystem::path folder;      ///< working directory of the tasks: the campaign's folder, absolute
    std::string files;                 ///< folder of the batch, below `folder`
    std::string name;                  ///< of the job, unique
    int tasks;                         ///< indices 0 ... tasks - 1
    int cores;                         ///< of each task, each for one MPI rank of an engine
    scenario::BatchSettings settings;  ///< what is asked of the scheduler for every task
};

/// What a scheduler made of an array. Nothing was submitted when there is no job: there is no room now, or,
/// with `most_tasks`, the array is too large for this site.
struct Submission {
    std::optional<long> job = {};        ///< the scheduler's id
    std::optional<int> most_tasks = {};  ///< that one array may have here; fewer than it has
};

/// An array that was submitted, or that may have been.
struct SubmittedArray {
    std::string name;         ///< of the job
    std::optional<long> job;  ///< the scheduler's id; none when the driver died before it wrote the id down
    int tasks;                ///< number of its tasks
    bool is_counted = false;  ///< whether the accounting knows of it, as count_core_time() found
};

/// What a scheduler knows of one task.
struct TaskReport {
    /// Where the task stands.
    enum State { waiting, running, ended };
    State state;  ///< where it stands
    /// For a task that ended, why it did so, as far as the scheduler knows.
    core::Outcome outcome = core::Outcome::interrupted;
    std::string message = {};  ///< one line for people; may be empty while the task has not ended
};

/// By the job's name and the index of the task.
using TaskReports = std::map<std::pair<std::string, int>, TaskReport>;

/// How a scheduler warns a task before its end and puts it into the queue again. Empty texts: it does not.
struct Requeueing {
    std::string_view option;  ///< in the key extra: the task may be queued again
    std::string_view
        warning;  ///< how the option in the key extra begins that asks for SIGUSR1 before the end
    std::string_view command;  ///< of the shell, with which a task puts itself into the queue again
};

/// A scheduler of job arrays: its functions, and the words that differ between schedulers.
///
/// To add one, write its functions in one file, declare it below, and list it in executors.cpp. Its keys are
/// a section of [run] with its name (src/scenario/reader/run_section.cpp).
struct Scheduler {
    std::string_view name;        ///< word of run.executor, section of its keys, folder of its batches
    std::string_view title;       ///< in messages
    std::string_view task_index;  ///< what the job script calls the index of its task, for the shell
    std::string_view job_id;      ///< what it calls the number of its job
    Requeueing requeueing;        ///< of a task that was warned

    /// Submits an array, after asking whether it could ever start: most schedulers also take jobs that wait
    /// for ever.
    /// @throws core::MissingError with the scheduler's own words when it refuses, or is not there
    Submission (*submit)(JobArray const& array);

    /// What is known of the arrays' tasks, with as few calls as possible. A task that is missing from the
    /// answer is unknown to the scheduler. Looks for arrays without an id by their name, and adds the id.
    /// @return nothing when the scheduler does not answer: then nothing must be concluded
    /// @throws core::MissingError when there is no such scheduler here
    std::optional<TaskReports> (*ask)(std::vector<SubmittedArray>& arrays);

    /// Takes tasks of an array out of the queue. A task that has started meanwhile may go on.
    void (*cancel)(SubmittedArray const& array, std::vector<int> const& tasks);

    /// What the site has counted for the arrays in its accounting: s, cores of each task times the time that
    /// it had them, also of tasks that were run again. Nothing where there is no accounting, or where this
    /// scheduler is not asked for it. Notes which arrays the accounting knows.
    std::optional<double> (*count_core_time)(std::vector<SubmittedArray>& arrays) = nullptr;
};

extern Scheduler const slurm;  ///< Slurm

}  // namespace vibrotrough::campaign
