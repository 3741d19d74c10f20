#pragma once

#include "campaign/schedule/policy.hpp"
#include "campaign/state/foreign_commands.hpp"
#include "campaign/state/plan.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace vibrotrough::campaign {

/// How the work on a packing ended.
struct WorkResult {
    /// How the work on a packing can end.
    enum Kind {
        finished,         ///< the packing is finished, now or before
        busy,             ///< another process runs it
        failed,           ///< failure.json says why
        interrupted,      ///< SIGTERM or SIGINT
    } kind;               ///< how it ended
    std::string message;  ///< one line for people
};

/// Limits of the work on a packing.
struct WorkLimits {
    int ranks = 1;                          ///< MPI ranks of the engine
    int retries = 0;                        ///< after a failure that may not happen again
    ForeignCommands foreign_commands = {};  ///< which of them the engine may run
    std::optional<double> time_limit;       ///< s of wall clock, all attempts together
};

/// Runs one packing of one case in its own event loop, and writes the case's result when its policy calls the
/// finished packings enough. May be called for the same packing by several processes, also on several
/// machines: one of them works.
/// @throws core::InputError when the folder holds no such case, or one with commands that are not allowed
/// @throws core::MissingError when the engine is not the one that the campaign was planned with, or the disk
/// refuses
WorkResult work(std::filesystem::path const& campaign_folder, PackingId const& id, WorkLimits const& limits,
                Policy const& policy);

}  // namespace vibrotrough::campaign
