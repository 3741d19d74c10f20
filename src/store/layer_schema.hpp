#pragma once

#include "store/schema.hpp"

#include <vector>

/// @file
/// The part of the schema that describes how the layer moves within the cycle.

namespace vibrotrough::store {

/// Values of a case: means or largest values over its packings.
std::vector<CaseValue> layer_case_values();
/// Values of each packing.
std::vector<PackingValue> layer_packing_values();

}  // namespace vibrotrough::store
