#pragma once

#include "campaign/execute/packing_run.hpp"
#include "campaign/measured_packing.hpp"
#include "campaign/state/plan.hpp"

#include <optional>
#include <string>

namespace vibrotrough::campaign {

// How a case comes to its end, whoever ran its packings: several processes, also on several machines, may
// call these at once. A lock of the case lets one at a time through.

/// Puts the case's result in its place when all its packings are finished and it has none yet.
/// @param known  packings that were measured already; the others are read from their folders
/// @return the result, or nothing while packings are missing
/// @throws InputError when a packing's files are damaged
/// @throws MissingError when the disk refuses
std::optional<store::CaseRecord> finish_case(PlannedCase const& planned, std::string const& engine_version,
                                             MeasuredPackings known = {});

/// Writes failure.json for a packing that failed, and counts the attempts.
/// @throws MissingError when the disk refuses
void record_failure(PlannedCase const& planned, int packing, PackingOutcome const& outcome);

}  // namespace vibrotrough::campaign
