#pragma once

#include "theory/conveyor.hpp"

namespace vibrotrough::theory {

/// The motion that develops from rest, followed in small steps that provably do not skip the end of a phase;
/// without a model. For tests only: the solver finds the phases from the zeros of the forces instead.
///
/// The normal motion is followed until its state at the start of a cycle recurs after 1 to 64 cycles; the
/// motion along the trough is then the fixed point of a map of one velocity. Two successive periods must
/// agree to 1e-9, because long chains of rebounds amplify rounding errors. If the state does not recur within
/// 3000 cycles, the mean of eta is given with the half-width of its confidence interval from 20 batches
/// (Student's t). A batch has 125 cycles; more where flights are long, fewer where phases are very many.
///
/// With more than one friction coefficient and weak forces it takes for a mean what still changes, and it
/// does not see that a mass runs away where landings have less friction than slides.
/// @param conveyor  within its ranges
/// @throws PhaseError when a phase cannot be solved
ConveyorMotion walked_motion(Conveyor const& conveyor);

}  // namespace vibrotrough::theory
