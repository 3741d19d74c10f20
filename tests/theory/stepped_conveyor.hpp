#pragma once

#include "theory/conveyor.hpp"

namespace vibrotrough::theory {

/// eta by a loop of fixed small steps over the equations of motion, for checks only.
double steady_efficiency_by_steps(Conveyor const& conveyor, FlightStart start);

}  // namespace vibrotrough::theory
