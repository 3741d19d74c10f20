#pragma once

#include "theory/conveyor.hpp"

#include <optional>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// The answer of solve(Conveyor) where it needs no mean over thousands of cycles: motions that have a period
/// or run away. Nothing for others.
/// @throws PhaseError when a phase cannot be solved
std::optional<ConveyorMotion> motion_with_period(Conveyor const& conveyor);

}  // namespace vibrotrough::theory::detail
