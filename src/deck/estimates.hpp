#pragma once

#include "prepare/prepared_case.hpp"

/// Rough numbers of a case before anything is simulated, by formulas of one line. SI units.
namespace vibrotrough::deck {

/// Weight that one grain of the bottom layer carries, N: the layer's weight over its number, one per d^2 of
/// floor. Forces in a packing scatter about this mean; three times as much is not rare.
double bottom_load(prepare::PreparedCase const& prepared);

/// Hertz overlap of a grain on the trough under `force`, m: (3 F / (4 E* sqrt(R)))^(2/3), E* = E / (2 (1 -
/// nu^2)) (Johnson, Contact Mechanics, 1985, section 4.2; trough and grain of one material).
double overlap_under(prepare::PreparedCase const& prepared, double force);

/// Largest overlap of a single grain that hits the trough with `speed`, m: its kinetic energy is the Hertz
/// contact's, m v^2 / 2 = 8/15 E* sqrt(R) d^(5/2) (Johnson, section 11.4). Damping makes it smaller.
double overlap_at_impact(prepare::PreparedCase const& prepared, double speed);

/// Duration of that impact, s: 2.87 (m^2 / (R E*^2 v))^(1/5) (Johnson, section 11.4); of a block, what
/// solver.block_stiffness says.
double impact_duration(prepare::PreparedCase const& prepared, double speed);

/// The point mass's longest flight (Sloot & Kruyt, Eq. 15), s; 0 when it stays on the trough.
double flight_time(prepare::PreparedCase const& prepared);

/// Steps in which a grain at `speed` travels half the neighbour lists' skin: the lists live that long.
double steps_between_rebuilds(prepare::PreparedCase const& prepared, double speed);

/// Cycles that one packing will take: 12 of start-up and as many as its own interval needs, (2 s /
/// half_width)^2 with a scatter of s = 0.03 per independent cycle (18 packings of validation/demo: 0.011 to
/// 0.068, median 0.027; their start-up 5 to 27 cycles, median 11), at least 20 and at most max_cycles.
double expected_cycles(prepare::PreparedCase const& prepared);

/// Grain-steps of the whole case: all packings, settling included (five times the time of the fall; less when
/// another case has settled the same packing); a clump counts as its spheres.
double expected_work(prepare::PreparedCase const& prepared);

/// Bytes that the case will write: 120 per grain and frame of the first packing, 160 per cycle.
double expected_bytes(prepare::PreparedCase const& prepared);

/// Skin of the neighbour lists in grain diameters, as in the deck.
constexpr double skin_in_diameters = 0.3;

}  // namespace vibrotrough::deck
