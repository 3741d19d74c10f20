#pragma once

#include "campaign/execute/executors.hpp"

#include <filesystem>
#include <memory>
#include <vector>

namespace vibrotrough::campaign {

/// Runs packings as tasks of Slurm's job arrays. They go on when this process ends.
std::unique_ptr<Executor> make_slurm_executor(ExecutorInputs const& inputs);

/// What Slurm and the tasks' own markers say of the packings that were submitted for a campaign. Writes
/// nothing.
std::vector<PackingActivity> slurm_activity(std::filesystem::path const& campaign_folder);

}  // namespace vibrotrough::campaign
