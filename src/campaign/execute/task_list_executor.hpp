#pragma once

#include "campaign/execute/executors.hpp"

#include <memory>

namespace vibrotrough::campaign {

/// Writes the packings into a task list for another scheduler, ExecutorInputs::task_list, and the decks of
/// their cases; it runs nothing. `vibrotrough work` runs a line of the list. Packings that such a process
/// simulates now are left out.
std::unique_ptr<Executor> make_task_list_executor(ExecutorInputs const& inputs);

}  // namespace vibrotrough::campaign
