#pragma once

#include "theory/detail/plastic/contact.hpp"

#include <vector>

// The motion normal to a sinusoidally driven trough with perfectly plastic landing. Internal to this room.
// Heights in r sin(beta), time in 1/omega.
namespace vibrotrough::theory::detail {

/// A flight. It depends on Gamma alone, not on the motion along the trough.
struct Flight {
    Instant start, end;
    double approach;  ///< normal velocity relative to the trough at landing, in omega r sin(beta), >= 0
    double duration() const { return end.t - start.t; }
};

/// The flight that starts at arcsin(1/Gamma) (Eqs. 12-14), for Gamma in (1, sqrt(1 + pi^2)).
///
/// It ends after d with sqrt(Gamma^2 - 1) (d - sin d) = d^2/2 - 1 + cos d (Eq. 15 with d = 2 pi n). The ratio
/// of the two sides increases with d, so that the zero is unique; a table of the inverse gives the first
/// guess.
Flight standard_flight(double throw_number);

/// The flight of a mass that leaves the trough at `start` with the velocity of the trough (Eqs. 12-14). It
/// ends at the first zero of h(d) = sin(start) (1 - cos d) + cos(start) (d - sin d) - d^2 / (2 Gamma). Range:
/// sin(start) >= 1/Gamma (up to rounding), Gamma > 1.
Flight plastic_flight(double inverse_throw, Instant start);

/// One period of the normal motion.
struct NormalMotion {
    /// In order; a flight that starts when the previous one ends takes off again at once.
    std::vector<Flight> flights;
    Instant start{}, end{};  ///< one period: a whole number of cycles
    int cycles = 1;          ///< 0 when no period was found
};

/// Sets `motion` to the periodic normal motion for Gamma > 1, reusing its memory.
void find_normal_motion(double throw_number, NormalMotion& motion);

}  // namespace vibrotrough::theory::detail
