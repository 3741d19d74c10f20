#pragma once

#include "theory/conveyor.hpp"
#include "theory/detail/contact.hpp"
#include "theory/detail/flight.hpp"

// Internal to this room.
namespace vibrotrough::theory::detail {

/// The motion of Sloot & Kruyt's point mass with all that it was found from.
struct PlasticOrbit {
    Law law{};              ///< of the problem that was solved: with_noticeable_forces() of the input
    NormalMotion normal{};  ///< one period, or all flights that were followed if no period was found
    double velocity = 0;    ///< slip velocity at the start of the period, in omega r cos(beta)
    Motion motion{};        ///< its phases are those of `normal`, shifted by whole cycles
};

/// Solves as theory::solve(PointMass). @throws the same
PlasticOrbit solve_orbit(PointMass const& input);

/// Adds the pieces and impacts of one period of an orbit that is periodic.
void add_pieces(PlasticOrbit const& orbit, ConveyorMotion& answer);

}  // namespace vibrotrough::theory::detail
