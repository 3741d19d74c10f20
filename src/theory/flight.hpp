#pragma once

#include "theory/contact.hpp"

#include <vector>

// The motion normal to a sinusoidal trough with plastic landing. Internal to the room.
// Heights in r sin(beta), time in 1/omega.
namespace vibrotrough::theory::detail {

/// When a mass that leaves the trough at `start` with its velocity lands (Eqs. 12-14): the first zero of
/// h(d) = sin(start) (1 - cos d) + cos(start) (d - sin d) - d^2 / (2 Gamma).
/// Range: sin(start) >= 1/Gamma (up to rounding), Gamma > 1.
Flight plastic_flight(double inverse_throw, double start);

/// One period of the normal motion.
struct NormalMotion {
    std::vector<Flight> flights;  ///< in order; a flight that starts where the one before ended is a relaunch
    double start = 0, end = 0;    ///< one period: a whole number of cycles
    int cycles = 1;               ///< 0 when no period was found
};

/// The periodic normal motion; for Gamma <= 1 one cycle of contact.
NormalMotion normal_motion(double throw_number);

}  // namespace vibrotrough::theory::detail
