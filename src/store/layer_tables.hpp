#pragma once

#include "store/schema.hpp"

#include <vector>

namespace vibrotrough::store {

/// The tables that every packing has: its cycles, and how its layer moves within the cycle.
std::vector<PackingTable> layer_tables();

}  // namespace vibrotrough::store
