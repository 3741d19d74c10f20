#pragma once

#include "theory/quantities.hpp"

namespace vibrotrough::theory {

/// What an engineer needs of the plastic point mass in a search: two of EngineerQuantities.
struct PlasticQuantities {
    double impact_speed;  ///< m/s, largest speed of the mass relative to the trough at an impact; 0 without
    double mean_power;    ///< W/kg, that the trough gives to the mass
};

/// From the phases of solve(PointMass) in closed form, up to the friction's work, which is a quadrature (15
/// points per slide). It takes microseconds, engineer_quantities() about a thousand times as long.
///
/// Within a phase the velocity relative to the trough obeys v' = b sin t - c (Eqs. 6-16), so that the phase's
/// displacement gives its value at the start. The power follows from the energy that is lost in a period, by
/// friction and impacts, and gained by lifting.
/// @throws std::invalid_argument when the motion is not periodic
PlasticQuantities plastic_quantities(Motion const& motion, PointMass const& point, Machine const& machine);

}  // namespace vibrotrough::theory
