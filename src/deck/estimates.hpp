#pragma once

#include "prepare/prepared_case.hpp"

/// Estimates for a case before anything is simulated, from one-line formulas. SI units.
namespace vibrotrough::deck {

/// Mean force on a grain at the bottom, N: the weight of the layer divided by the number of bottom grains,
/// one per d^2 of floor. Forces in a packing scatter about this mean; three times the mean is not rare.
double bottom_load(prepare::PreparedCase const& prepared);

/// Hertz overlap of a grain on the trough under `force` (N), m: (3 F / (4 E* sqrt(R)))^(2/3) with E* = E / (2
/// (1 - nu^2)) (Johnson, Contact Mechanics, 1985, section 4.2; trough and grain of the same material).
double overlap_under(prepare::PreparedCase const& prepared, double force);

/// Largest overlap of a single grain that hits the trough with `speed` (m/s), m. All its kinetic energy
/// becomes energy of the Hertz contact, m v^2 / 2 = 8/15 E* sqrt(R) d^(5/2) (Johnson, section 11.4). Damping
/// makes it smaller.
double overlap_at_impact(prepare::PreparedCase const& prepared, double speed);

/// Duration of that impact, s: 2.87 (m^2 / (R E*^2 v))^(1/5) (Johnson, section 11.4). For a block it is given
/// by solver.block_stiffness.
double impact_duration(prepare::PreparedCase const& prepared, double speed);

/// Longest flight of the point mass (Sloot & Kruyt, Eq. 15), s; 0 when it stays on the trough.
double flight_time(prepare::PreparedCase const& prepared);

/// Number of steps in which a grain at `speed` (m/s) travels half the skin of the neighbour lists, after
/// which they must be rebuilt.
double steps_between_rebuilds(prepare::PreparedCase const& prepared, double speed);

/// What the cost of a case is expected from: what other cases have shown, or what was seen before.
struct Experience {
    /// Standard deviation of the mean efficiency of one packing of 24 cycles. In the layer of
    /// tests/measure/reference it was 0.01 to 0.04 at throw numbers from 0.8 to 3, in validation/demo the
    /// same.
    double deviation = 0.03;
    double cycles = 24;  ///< of one packing; those of the first round of a campaign
};

/// The number of packings that a case will probably have: as many as make Student's interval as narrow as
/// measure.half_width asks, from measure.packings to measure.max_packings.
int expected_packings(scenario::MeasurementPlan const& plan, Experience const& experience = {});

/// Number of cycles that one packing will take, at most max_cycles.
double expected_cycles(scenario::MeasurementPlan const& plan, Experience const& experience = {});

/// Grain-steps of one packing, including settling (five times the time of a free fall; less if another case
/// has settled the same packing). A clump counts with the number of its spheres.
double expected_work(prepare::PreparedCase const& prepared, Experience const& experience = {});

/// Number of bytes that the case will write: 120 per grain and frame of the first packing, 160 per cycle.
double expected_bytes(prepare::PreparedCase const& prepared);

/// Skin of the neighbour lists in grain diameters, which the deck uses.
constexpr double skin_in_diameters = 0.3;

}  // namespace vibrotrough::deck
