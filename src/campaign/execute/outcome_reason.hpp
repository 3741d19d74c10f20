#pragma once

#include "campaign/execute/packing_run.hpp"
#include "campaign/state/plan.hpp"

namespace vibrotrough::campaign {

/// How many processes the kernel of this machine has killed for want of memory so far; 0 where it does not
/// say.
long count_memory_kills();

/// Looks behind a packing's failure: the engine's own word for a full disk is silence, for want of memory a
/// signal, and for a simulation that blew up a wrong number. Adds how far the run had come.
/// @param memory_kills  count_memory_kills() from before the run
PackingOutcome find_reason(PlannedCase const& planned, int packing, PackingOutcome outcome,
                           long memory_kills);

}  // namespace vibrotrough::campaign
