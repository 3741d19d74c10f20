#pragma once

#include "campaign/packing_run.hpp"
#include "campaign/plan.hpp"

#include <optional>
#include <string>

namespace vibrotrough::campaign {

// How a case comes to its end, whoever ran its packings: several processes, also on several machines, may
// call these at once. A lock of the case lets one at a time through.

/// Puts the case's result in its place when all its packings are finished and it has none yet.
/// @return the result's outcome, or nothing while packings are missing
/// @throws InputError when a packing's files are damaged
/// @throws MissingError when the disk refuses
std::optional<std::string> finish_case(PlannedCase const& planned, std::string const& engine_version);

/// Writes failure.json for a packing that failed, and counts the attempts.
/// @throws MissingError when the disk refuses
void record_failure(PlannedCase const& planned, int packing, PackingOutcome const& outcome);

}  // namespace vibrotrough::campaign
