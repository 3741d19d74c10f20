#pragma once

#include "store/quantity.hpp"

#include <vector>

namespace vibrotrough::store {

/// The quantities that tell how the layer moves within the cycle and what it does to its machine.
std::vector<Quantity> layer_quantities();

}  // namespace vibrotrough::store
