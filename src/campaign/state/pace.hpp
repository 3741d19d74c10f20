#pragma once

#include "campaign/state/plan.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::campaign {

/// How far the run of a packing is that has no marker yet, and how fast it goes.
struct PackingPace {
    int packing;                              ///< its number, from 1
    int cycles;                               ///< simulated so far
    std::optional<double> seconds_per_cycle;  ///< wall time; none before the first cycle
};

/// The packings of a case that were started and have not ended, from their files. Writes nothing.
///
/// The pace is that of the run up to its last checkpoint or, before the first one, of the time between the
/// start of the engine and the last cycle.
std::vector<PackingPace> packings_under_way(PlannedCase const& planned);

}  // namespace vibrotrough::campaign
