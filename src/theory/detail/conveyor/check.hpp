#pragma once

#include "theory/conveyor.hpp"

#include <string>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// @throws std::invalid_argument when an input is out of range
void check_ranges(Conveyor const& conveyor);

/// The inputs as text from which they can be reproduced.
std::string inputs_text(Conveyor const& conveyor);

}  // namespace vibrotrough::theory::detail
