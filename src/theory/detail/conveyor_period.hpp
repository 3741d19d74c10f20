#pragma once

#include "theory/conveyor.hpp"

#include <optional>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// The motion that develops from rest, followed in small steps that provably do not skip the end of a phase;
/// without a model. It answers where ConveyorEfficiency does not.
///
/// The normal motion is followed until its state at the start of a cycle recurs after 1 to 64 cycles; the
/// motion along the trough is then the fixed point of a map of one velocity. Two successive periods must
/// agree to 1e-9, because long chains of rebounds amplify rounding errors. If the state does not recur within
/// 3000 cycles, the mean of eta is given with the half-width of its confidence interval from 20 batches
/// (Student's t). A batch has 125 cycles; more where flights are long, fewer where phases are very many.
/// @param conveyor  within its ranges
/// @throws PhaseError when a phase cannot be solved
ConveyorMotion walked_motion(Conveyor const& conveyor);

/// The answer of walked_motion() where it needs no mean over thousands of cycles: motions that have a period
/// or run away. Nothing for others.
/// @param conveyor  its forces are noticeable (see weak_forces.hpp)
/// @throws PhaseError when a phase cannot be solved
std::optional<ConveyorMotion> motion_with_period(Conveyor const& conveyor);

}  // namespace vibrotrough::theory::detail
