#pragma once

#include "theory/detail/common/fixed_point.hpp"
#include "theory/detail/plastic/contact.hpp"
#include "theory/detail/plastic/flight.hpp"

#include <cmath>

// The periodic motion along the trough as a fixed point. Internal to this room.
namespace vibrotrough::theory::detail {

/// Follows the motion along the trough over one period of the normal motion, from velocity v at its start.
template <class Record>
Tangent follow_period(Law const& law, NormalMotion const& normal, double v, Hints& hints, Record&& record) {
    Tangent s{v, 1};
    hints.next = 0;
    auto const& flights = normal.flights;
    if (flights.empty()) return follow_contact(law, s, normal.start, normal.end, false, hints, record);
    for (std::size_t i = 0; i < flights.size(); ++i) {
        Flight const& flight = flights[i];
        double const h = flight.duration();
        // Eq. 16: no friction, only gravity along the trough.
        double const moved = s.v * h - law.gravity * h * h / 2 - sine_excess(flight.start, flight.end);
        record(PhaseKind::flight, flight.start, flight.end, moved, s.slope);
        s.v += -law.gravity * h - (flight.end.cosine - flight.start.cosine);
        s = landed(s, law.friction_tangent * flight.approach);
        Instant const next = i + 1 < flights.size() ? flights[i + 1].start : normal.end;
        s = follow_contact(law, s, flight.end, next, true, hints, record);
    }
    return s;
}

/// Without a flight the period may start anywhere. It is made to start where a slide begins, so that v = 0 is
/// exact if there is a rest before it. @return false when no slide ever begins
inline bool start_at_slide(Law const& law, NormalMotion& normal) {
    normal.flights.clear();
    if (!law.positive.can_start() && !law.negative.can_start()) return false;
    normal.start = (law.positive.can_start() ? law.positive : law.negative).begin();
    normal.end = normal.start;
    normal.end.t += two_pi;
    normal.cycles = 1;
    return true;
}

/// One period of the steady motion along the trough.
struct SteadyMotion {
    double v;    ///< slip velocity at its start, to 1e-13
    double eta;  ///< mean slip velocity
};

/// Finds the steady motion over one period of the normal motion. The same inputs give the same bits, whatever
/// was solved before.
/// @param phases  is cleared and then takes the phases of the period by add(kind, from, to, displacement);
/// one
///                that lasts less than shortest_phase is left out
template <class Phases>
SteadyMotion find_steady_motion(Law const& law, NormalMotion const& normal, Phases& phases) {
    // The last Newton step is added to first order. It is so small that it changes neither the mode nor the
    // sum of the phases.
    constexpr double velocity_tolerance = 1e-13;
    Hints hints;
    double displacement = 0, derivative = 0;
    auto const record = [&](PhaseKind kind, Instant from, Instant to, double moved, double slope) {
        double const h = to.t - from.t;
        displacement += moved;
        derivative += slope * h;  // the time of a stop changes too, but the speed is zero there
        if (h > shortest_phase) phases.add(kind, from, to, moved);
    };
    auto const period = [&](double v0) {
        phases.clear();
        displacement = derivative = 0;
        return follow_period(law, normal, v0, hints, record);
    };
    FixedPoint const start = fixed_point(period, 0, velocity_tolerance);
    return {start.v, (displacement + derivative * start.error) / (normal.end.t - normal.start.t)};
}

}  // namespace vibrotrough::theory::detail
