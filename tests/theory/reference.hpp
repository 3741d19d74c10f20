#pragma once

#include "theory/point_mass.hpp"

namespace vibrotrough::theory {

/// eta of the plastic point mass by a second formulation, for checks only: absolute velocity in long double,
/// the forces asked at small steps (no slip angles), events bisected, started from rest and repeated until
/// the velocity at the start of a period repeats. Shares no code with the library. Returns NaN when it does
/// not repeat within `periods`.
long double reference_efficiency(PointMass const& input, int period_cycles, int periods = 3000);

}  // namespace vibrotrough::theory
