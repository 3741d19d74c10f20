#pragma once

#include "scenario/run_settings.hpp"
#include "scenario/scenario.hpp"

namespace vibrotrough::campaign {

/// MPI ranks for one packing: what [run] ranks says, else one rank, or more when cores would stand idle and
/// the case is big enough. Two ranks never paid below 20,000 grains (measured, LIGGGHTS 3.8.0), so that each
/// rank gets at least 10,000.
/// @param cores  that this packing may use, at least 1
int choose_ranks(RunSettings const& settings, Scenario const& scenario, int cores);

}  // namespace vibrotrough::campaign
