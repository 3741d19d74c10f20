#pragma once

#include "theory/detail/conveyor_waves.hpp"

#include <vector>

// The motion of a conveyor's mass normal to the trough, with rebounds, drag and harmonics. Internal to this
// room.
namespace vibrotrough::theory::detail {

/// A flight, and the contact that may follow it. Rates are relative to the trough, in omega r sin(beta).
struct Hop {
    Instant start, end;  ///< of the flight; it starts within [0, 2 pi)
    Instant leave;       ///< where the next flight starts: later than the landing when there is a contact
    double approach;     ///< rate at the landing, >= 0
    double rebound;      ///< rate with which the next flight starts, >= 0
    Decayed decayed;     ///< over its duration
};

/// How a small change of phase and rebound at one landing changes those at the next: a 2 x 2 matrix.
struct Sensitivity {
    double phase_phase = 1, phase_rate = 0, rate_phase = 0, rate_rate = 1;

    /// This change after an earlier one.
    Sensitivity after(Sensitivity const& earlier) const;
    double size() const;
};

/// Finds the flights of a conveyor one after another, in the order in which they happen.
class FlightChain {
  public:
    /// Where the chain stands.
    struct Start {
        Instant at{0, 0, 1};
        double rate = 0;  ///< upwards, relative to the trough; 0 at a take-off from contact
        /// The number of the zero of the normal force at which the mass leaves the trough from contact; -1
        /// elsewhere.
        int zero = -1;
    };

    explicit FlightChain(ConveyorWaves const& waves) : waves_(waves) {}

    /// The first flight of a mass that is at rest at t = 0. The normal force has zeros.
    Start first() const;
    /// The flight from there; `next` is set to where the flight after it starts.
    /// @throws PhaseError when it does not end
    Hop fly(Start const& start, Start& next) const;

    /// The sensitivity of the landing of a flight to its start.
    Sensitivity sensitivity(Hop const& hop, double start_rate) const;

  private:
    struct Ballistic;
    Start from_contact(Instant const& at) const;
    Hop flight(Start const& start) const;
    bool short_flight(Start const& start, Hop& hop) const;
    double lowest(Ballistic const& path, double low, double high) const;
    Hop landing(Start const& start, Ballistic const& path, double low, double high) const;

    ConveyorWaves const& waves_;
};

/// The flights of the periodic motion that develops from rest.
struct NormalOrbit {
    std::vector<Hop> hops;             ///< from rest on; those of the period come last
    std::size_t first = 0;             ///< of the period
    int cycles = 0;                    ///< of the period; 0 when none was found
    bool in_doubt = false;             ///< whether rounding errors may decide if there is a period
    bool in_contact = false;           ///< whether the mass never leaves the trough
    FlightChain::Start next;           ///< where the flight after the last one starts
    std::vector<std::size_t> left_at;  ///< hop that began at each zero of the normal force (memory)
    std::vector<double> rebounds;      ///< of all hops (memory)
    std::vector<bool> seen;            ///< of their rebounds (memory)
};

/// A take-off from contact with a rounding error of its own, as on a machine; others are as they were. Where
/// small changes grow by more than rounding allows for between two contacts, the calculation would otherwise
/// repeat a cycle of rounding errors for ever.
/// @param number  of the flight
FlightChain::Start with_rounding(FlightChain::Start start, std::size_t number);

/// Sets `orbit` for a conveyor, reusing its memory.
///
/// A motion counts as one without a period after 3000 cycles, or after 1000 if it is chaotic: if small
/// changes have grown by a factor of 1e10 in the last 500 of them, or if they grow by more than 1e11 from one
/// contact to the next, so that rounding decides what follows.
/// @throws PhaseError when a flight does not end
void find_normal_orbit(ConveyorWaves const& waves, NormalOrbit& orbit);

}  // namespace vibrotrough::theory::detail
