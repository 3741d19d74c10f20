#pragma once

#include "theory/conveyor.hpp"

namespace vibrotrough::theory {

/// eta of the steady motion of `period_cycles` by Runge and Kutta's rule over the equations of motion, for
/// checks only: shares nothing with the library.
double steady_efficiency_by_steps(Conveyor const& conveyor, int period_cycles);

}  // namespace vibrotrough::theory
