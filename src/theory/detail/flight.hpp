#pragma once

#include "theory/detail/contact.hpp"

#include <vector>

// The motion normal to a sinusoidal trough with plastic landing. Internal to the room.
// Heights in r sin(beta), time in 1/omega.
namespace vibrotrough::theory::detail {

/// A flight of the normal motion: fixed by Gamma alone, whatever happens along the trough.
struct Flight {
    Instant start, end;
    double approach;  ///< normal velocity against the trough at landing, in omega r sin(beta), >= 0
    double duration() const { return end.t - start.t; }
};

/// The flight that starts at arcsin(1/Gamma) (Eqs. 12-14), for Gamma in (1, sqrt(1 + pi^2)).
///
/// It lands after d where sqrt(Gamma^2 - 1) (d - sin d) = d^2/2 - 1 + cos d (Eq. 15 with d = 2 pi n).
/// The ratio of the two sides rises with d, so the zero is unique; a table of the inverse gives the first
/// guess.
Flight standard_flight(double throw_number);

/// When a mass that leaves the trough at `start` with its velocity lands (Eqs. 12-14): the first zero of
/// h(d) = sin(start) (1 - cos d) + cos(start) (d - sin d) - d^2 / (2 Gamma).
/// Range: sin(start) >= 1/Gamma (up to rounding), Gamma > 1.
Flight plastic_flight(double inverse_throw, Instant start);

/// One period of the normal motion.
struct NormalMotion {
    std::vector<Flight> flights;  ///< in order; a flight that starts where the one before ended is a relaunch
    Instant start{}, end{};       ///< one period: a whole number of cycles
    int cycles = 1;               ///< 0 when no period was found
};

/// Makes `motion` the periodic normal motion for Gamma > 1. Takes the memory of what it held before.
void find_normal_motion(double throw_number, NormalMotion& motion);

}  // namespace vibrotrough::theory::detail
