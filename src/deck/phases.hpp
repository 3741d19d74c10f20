#pragma once

#include "prepare/prepared_case.hpp"

#include <map>
#include <string>

namespace vibrotrough::deck {

/// The layer is cut into bins at this many phases, one after the other: every `profile_stride` of them, so
/// that each phase has its turn once in `profile_stride` cycles.
constexpr int profiles_per_cycle = 10;
constexpr int profile_stride = 3;

/// Numbers of the template `phases` by name: how often the layer is looked at within a cycle, and in what
/// bins. Lengths in m.
std::map<std::string, std::string> phase_sampling(prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::deck
