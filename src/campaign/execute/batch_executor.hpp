#pragma once

#include "campaign/execute/executors.hpp"
#include "campaign/execute/scheduler.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace vibrotrough::campaign {

/// Runs packings as tasks of a scheduler's job arrays. They go on when this process ends.
std::unique_ptr<Executor> make_batch_executor(Scheduler const& scheduler, ExecutorInputs const& inputs);

/// What a scheduler and the tasks' own markers say of the packings that were submitted for a campaign. Writes
/// nothing.
std::vector<PackingActivity> batch_activity(Scheduler const& scheduler,
                                            std::filesystem::path const& campaign_folder);

/// What the scheduler's accounting has counted for the campaign's arrays; nothing when none was submitted.
std::optional<CountedTime> batch_core_time(Scheduler const& scheduler,
                                           std::filesystem::path const& campaign_folder);

}  // namespace vibrotrough::campaign
