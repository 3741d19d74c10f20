#pragma once

#include "prepare/prepared_case.hpp"

#include <map>
#include <string>

namespace vibrotrough::deck {

/// Number of phases of a cycle at which the engine averages the layer in bins.
constexpr int profiles_per_cycle = 10;

/// A snapshot is taken at every third of these phases, so that each phase is reached once in three cycles.
constexpr int profile_stride = 3;

/// The numbers of the template `phases` by name: how often the layer is sampled within a cycle, and in which
/// bins. Lengths in m.
std::map<std::string, std::string> phase_sampling(prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::deck
