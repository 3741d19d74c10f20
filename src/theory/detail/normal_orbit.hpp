#pragma once

#include "theory/detail/flights.hpp"

// Internal to this module.
namespace vibrotrough::theory::detail {

inline constexpr std::size_t never = static_cast<std::size_t>(-1);

/// The flights of the periodic motion that develops from a start.
struct NormalOrbit {
    Instant begin{0, 0, 1};   ///< of the contact before the first flight, in the time of that flight
    std::vector<Hop> hops;    ///< from the start on; those of the period come last
    std::size_t first = 0;    ///< of the period
    int cycles = 0;           ///< of the period; 0 when none was found
    bool in_doubt = false;    ///< whether rounding errors may decide if there is a period
    std::vector<Hop> again;   ///< if so, the next period; empty when it has other contacts
    bool in_contact = false;  ///< whether the mass stays on the trough, after the hops if there are any
    FlightChain::Start next;  ///< where the flight after the last one starts
    std::vector<std::size_t> left_at;  ///< hop that began at each zero of the normal force; never: none did
    std::size_t joined = never;        ///< what `after_zero` has for a zero at which the mass took off
};

/// A take-off from contact with a rounding error of its own, as on a machine; others are as they were. Where
/// small changes grow by more than rounding allows for between two contacts, the calculation would otherwise
/// repeat a cycle of rounding errors for ever.
/// @param number  of the flight
FlightChain::Start with_rounding(FlightChain::Start start, std::size_t number);

/// Sets `orbit` for a conveyor and a start, reusing its memory.
///
/// A motion counts as one without a period after 3000 cycles and flights, or after 1000 if it is chaotic: if
/// small changes have grown by a factor of 1e10 in the last 500 of them, or if they grow by more than 1e11
/// from one contact to the next, so that rounding decides what follows.
/// @param after_zero  for each zero of the normal force: the known motion after a take-off there, or never.
/// Nothing more is to be known when the mass takes off at a known one.
/// @throws PhaseError when a flight does not end
void find_normal_orbit(Forces const& forces, MotionStart const& start, NormalOrbit& orbit,
                       std::vector<std::size_t> const* after_zero = nullptr);

}  // namespace vibrotrough::theory::detail
