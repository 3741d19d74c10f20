#pragma once

#include "theory/point_mass.hpp"

namespace vibrotrough::theory {

/// eta of the plastic point mass by a second formulation, for tests only. It uses the absolute velocity in
/// long double, evaluates the forces in small steps (without slip angles), bisects events, starts from rest
/// and continues until the velocity at the start of a period recurs. It does not share code with the library.
/// Returns NaN if the velocity does not recur within `periods`.
long double reference_efficiency(PointMass const& input, int period_cycles, int periods = 3000);

}  // namespace vibrotrough::theory
