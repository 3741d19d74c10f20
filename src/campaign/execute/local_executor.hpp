#pragma once

#include "campaign/execute/executors.hpp"

#include <memory>

namespace vibrotrough::campaign {

/// Runs packings on the cores of this machine, in the order given, each with its engine as a process of its
/// own. When the process ends, the engines end.
std::unique_ptr<Executor> make_local_executor(ExecutorInputs const& inputs);

}  // namespace vibrotrough::campaign
