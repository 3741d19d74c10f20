#pragma once

#include "store/schema.hpp"

#include <vector>

/// The part of the table that tells how the layer moves within the cycle.
namespace vibrotrough::store {

std::vector<CaseValue> layer_case_values();
std::vector<PackingValue> layer_packing_values();

}  // namespace vibrotrough::store
