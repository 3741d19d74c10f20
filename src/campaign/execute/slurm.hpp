#pragma once

#include "scenario/model/run_settings.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace vibrotrough::campaign::slurm {

// Slurm's own commands (sbatch, squeue, sacct, scontrol), each started with a list of words: no shell reads
// them.

/// A job array to submit.
struct Array {
    std::filesystem::path folder;      ///< working directory: the campaign's folder
    std::string script;                ///< below `folder`
    std::string output;                ///< pattern for what the tasks print, below `folder`
    std::string name;                  ///< of the job
    int tasks;                         ///< indices 0 ... tasks - 1
    int ranks;                         ///< MPI ranks of each task
    scenario::SlurmSettings settings;  ///< what is asked of Slurm for every task
};

/// Asks whether Slurm would take the array and could ever start it; it also takes jobs that wait for ever.
/// @return false when it has no room for so many tasks now (MaxJobCount), and will have it when others have
/// ended
/// @throws MissingError with the reason when it would never take the array
bool check(Array const& array);

/// Submits the array.
/// @return Slurm's job id; none when it has no room for so many tasks now
/// @throws MissingError with Slurm's own words when it refuses or is not there
std::optional<long> submit(Array const& array);

/// Number of tasks that one array may have here. @throws MissingError when Slurm does not answer
int most_array_tasks();

/// What Slurm knows of one task.
struct TaskReport {
    std::string state;   ///< Slurm's name, e.g. "RUNNING", "TIMEOUT"
    std::string reason;  ///< why it waits, in Slurm's words
};

/// By array job and index.
using Reports = std::map<std::pair<long, int>, TaskReport>;

/// What Slurm knows of the arrays' tasks: from squeue, and for those that it has forgotten from sacct, where
/// there is accounting; one call of each, however many there are. A task that is missing from the answer is
/// unknown to Slurm.
/// @return nothing when the controller does not answer: then nothing is known, and nothing must be concluded
std::optional<Reports> ask(std::set<long> const& jobs);

/// The array job with this name, if Slurm knows one; nothing when it knows none.
/// @throws MissingError when the controller does not answer
std::optional<long> find_by_name(std::string const& name);

/// Whether a task in this state will never go on.
bool is_terminal(std::string const& state);

}  // namespace vibrotrough::campaign::slurm
