#pragma once

#include "campaign/execute/packing_run.hpp"
#include "campaign/state/plan.hpp"

namespace vibrotrough::campaign {

/// How many processes the kernel of this machine has killed for want of memory so far; 0 where it does not
/// say.
long count_memory_kills();

/// Finds the cause behind a packing's failure: a full disk leaves the engine silent, lack of memory shows as
/// a signal, and a simulation that diverged as a wrong number. Adds how far the run had come.
/// @param memory_kills  count_memory_kills() from before the run
PackingEnd find_cause(PlannedCase const& planned, int packing, PackingEnd end, long memory_kills);

}  // namespace vibrotrough::campaign
