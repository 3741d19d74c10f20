#pragma once

#include "campaign/execute/batch.hpp"
#include "campaign/state/plan.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace vibrotrough::campaign {

/// How a task's work ended.
struct WorkResult {
    enum Kind {
        finished,     ///< the packing is finished, now or before
        busy,         ///< another process is at it
        failed,       ///< failure.json says why
        interrupted,  ///< SIGTERM or SIGINT
    } kind;
    std::string message;  ///< one line for people
};

/// Limits of a task's work.
struct WorkLimits {
    int ranks = 1;                     ///< MPI ranks of the engine
    int retries = 0;                   ///< after an end that may not come again
    std::optional<double> time_limit;  ///< s of wall clock, all tries together
};

/// Runs one packing of one case in its own event loop, and the case's end when this was its last packing.
/// May be called for the same packing by several processes, also on several machines: one of them works.
/// @throws InputError when the folder holds no such case
/// @throws MissingError when the engine is not the one that the campaign was planned with, or the disk
/// refuses
WorkResult work(std::filesystem::path const& campaign_folder, Task const& task, WorkLimits const& limits);

}  // namespace vibrotrough::campaign
