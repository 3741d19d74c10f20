#pragma once

#include "theory/conveyor.hpp"

namespace vibrotrough::theory {

/// eta of the steady motion with a period of `period_cycles`, by Runge-Kutta integration of the equations of
/// motion. For tests only; it does not share code with the library.
double steady_efficiency_by_steps(Conveyor const& conveyor, int period_cycles);

}  // namespace vibrotrough::theory
