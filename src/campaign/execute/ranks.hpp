#pragma once

#include "scenario/model/run_settings.hpp"
#include "scenario/model/scenario.hpp"

namespace vibrotrough::campaign {

/// Time on one rank over (ranks times time on several), by the number of grains that each rank has: measured
/// on two ranks (src/manual/costs.md), interpolated over the logarithm, constant beyond the largest
/// measured; 0 below the smallest, where nothing was measured.
double parallel_efficiency(double grains_per_rank);

/// MPI ranks for one packing: what [run] ranks says; else the most, up to `cores`, that leave each rank at
/// least 1000 grains and an efficiency of 0.6. Several ranks give the numbers of one up to rounding, and then
/// chaos: the same statistics, other digits.
/// @param cores  that this packing may use, at least 1
int choose_ranks(scenario::RunSettings const& settings, scenario::Scenario const& scenario, int cores);

}  // namespace vibrotrough::campaign
