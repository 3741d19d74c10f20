#pragma once

#include "theory/conveyor.hpp"

namespace vibrotrough::theory {

/// The efficiency of a conveyor with one sine in each direction and perfectly plastic landing, as a user of a
/// general integrator would find it: CVODE with Adams' formulas and root finding, phase by phase from rest
/// until two cycles agree to 1e-8. Relative tolerance 1e-9.
double efficiency_by_cvode(Conveyor const& conveyor);

}  // namespace vibrotrough::theory
