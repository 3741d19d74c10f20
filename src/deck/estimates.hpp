#pragma once

#include "prepare/prepared_case.hpp"

#include <optional>

/// Estimates for a case before anything is simulated, from one-line formulas. SI units.
namespace vibrotrough::deck {

/// Mean force on a grain at the bottom, N: the weight of the layer divided by the number of bottom grains,
/// one per d^2 of floor. Forces in a packing scatter about this mean; three times the mean is not rare.
double bottom_load(prepare::PreparedCase const& prepared);

/// Overlap of a mean grain on the trough under `force` (N), m. For this and what follows see
/// prepare::Contact.
double overlap_under(prepare::PreparedCase const& prepared, double force);

/// A packing is at rest when its kinetic energy is less than its weight times this height, m: 1e-7 diameters,
/// but less where grains are so stiff that even this makes them press now more, now less on the trough. Like
/// a mass m on a spring that its weight compresses by D, a layer with the kinetic energy E presses with up to
/// m g (1 + sqrt(2 E / (m g D))); E = 1e-4 m g D keeps this below 1.5 %.
double height_at_rest(prepare::PreparedCase const& prepared);

/// By how much the force of a packing at rest may differ from its weight, over the weight: 0.02, where 0.004
/// was seen (20 packings of 20 to 500 grains). Grains whose height_at_rest() is lower ring: their kinetic
/// energy is small each time that their contacts hold all of it. 0.04 was seen with 1 and 2 GPa, so that they
/// have 0.08; the weight is known better from the cycles (evaluate).
double rest_tolerance(prepare::PreparedCase const& prepared);

/// Largest overlap of a mean grain that hits the trough with `speed` (m/s), m.
double overlap_at_impact(prepare::PreparedCase const& prepared, double speed);

/// Duration of that impact, s. For a block it is given by solver.block_stiffness.
double impact_duration(prepare::PreparedCase const& prepared, double speed);

/// Bond number of a grain on the trough: the pull that separates them over the grain's weight normal to the
/// trough. The granular Bond number is the ratio of attraction to weight; layers are cohesive when it is
/// large against 1 (Castellanos, Advances in Physics 54, 2005, 263). Between two grains the
/// pull is a quarter of that. 0 where a contact holds no pull.
double bond_number(prepare::PreparedCase const& prepared);

/// Attraction over the force of the spring of a grain on the trough, where both are proportional to the
/// overlap: from 1 on, grains fall into each other.
std::optional<double> attraction_ratio(prepare::PreparedCase const& prepared);

/// Longest flight of the point mass (Sloot & Kruyt, Eq. 15), s; 0 when it stays on the trough.
double flight_time(prepare::PreparedCase const& prepared);

/// Number of steps in which a grain at `speed` (m/s) travels half the skin of the neighbour lists, after
/// which they must be rebuilt.
double steps_between_rebuilds(prepare::PreparedCase const& prepared, double speed);

/// What the cost of a case is expected from: what other cases have shown, or what was seen before.
struct Experience {
    /// Standard deviation of the mean efficiency of one packing of 24 cycles: root mean square of 18 cases of
    /// campaigns that `init` writes (throw numbers 1 to 3; 0.002 to 0.028). It is larger in smaller boxes.
    double deviation = 0.011;
    std::optional<double> cycles{};  ///< of one packing; none: those of the first round of a campaign
};

/// Whether the grains of a case may get a speed before the drive begins. Clumps start at rest: LIGGGHTS 3.8.0
/// sets the velocities of their spheres, but not those of the bodies, which then begin as slowly as without
/// the command. So do blocks, layers that are shaken along the trough, and drives with stages, whose start is
/// measured. An open trough begins empty.
bool may_start_moving(scenario::Scenario const& scenario);

/// Cycles of a packing in the first round of a case: 24, and as few as 18 when an interval is asked for that
/// is wider than 0.055.
///
/// A start-up that nobody notices leaves an error of c / n in the mean of n cycles (Whitt, Management Science
/// 37, 1991, 645-666): the wider the interval, the fewer cycles make the error small against it. In
/// tests/measure/reference c is 0.43 at throw number 1.2 (8 to 24 cycles) and at most 0.22 at the five others
/// (16 to 24 cycles), so that n = 1.35 / half_width leaves an error of at most a third of the half-width.
/// Packings that start at rest need longer, and the interval of a single packing needs 20 cycles: both
/// have 24. A drive with stages has all cycles of its stages.
int first_round_cycles(scenario::Scenario const& scenario);

/// The number of packings that a case will probably have: as many as make Student's interval as narrow as
/// measure.half_width and the numerical errors ask, from measure.packings to measure.max_packings. The case's
/// Young's modulus must be known.
int expected_packings(scenario::Scenario const& scenario, Experience const& experience = {});

/// The same for any half-width wanted.
/// @param statistics  prepare::statistics_plan() for it
/// @param whole       the half-width wanted of statistics and numerics together
int expected_packings(scenario::MeasurementPlan const& statistics, double whole,
                      Experience const& experience = {});

/// The half-width of statistics with which a case may end that has so many packings, of which it may have
/// more. Fewer than six can agree by chance more often than their interval says, when their offsets are
/// skewed or they all are in one of two branches; they count only when it is at most half of the whole that
/// is wanted.
double trusted_half_width(int packings, scenario::MeasurementPlan const& statistics, double whole);

/// Number of cycles that one packing will take, at most max_cycles.
double expected_cycles(scenario::Scenario const& scenario, Experience const& experience = {});

/// The forecast of what a case costs, from which `check`, `plan`, `status` and the progress of a run all make
/// theirs: in grain-steps of a small layer (prepare::PreparedCase::work). A clump counts with the number of
/// its spheres.
/// @param settlings  packings that settle, for five times the time of a free fall; less if another case has
/// settled the same packing
/// @param cycles     of all packings together
double work_of(prepare::PreparedCase const& prepared, double settlings, double cycles);

/// Whether the work of a case is that of its grains alone. Of meshes, feeds and stages it is a rough guess.
bool is_plain(prepare::PreparedCase const& prepared);

/// The work of so many packings that are not begun, each of expected_cycles().
double expected_work(prepare::PreparedCase const& prepared, double packings,
                     Experience const& experience = {});

/// Grain-steps of a small layer per second and core, where nothing was measured yet: Debian's LIGGGHTS 3.8.0
/// with 600 to 5000 grains.
constexpr double usual_speed = 5e6;

/// Number of bytes of all files of a case with so many packings of so many cycles. The lengths of the rows
/// and of what is written once are means of real runs with 60 to 2000 grains; the estimate is within a factor
/// of 2 of a run (tests/end_to_end/check_test.py).
double bytes_of(prepare::PreparedCase const& prepared, double packings, double cycles);

/// The same for the packings and cycles that the case will probably have.
double expected_bytes(prepare::PreparedCase const& prepared);

/// The same for measure.max_packings packings of measure.max_cycles cycles: it cannot be more.
double largest_bytes(prepare::PreparedCase const& prepared);

/// Number of bytes of memory of one engine on all its ranks: 36 MB for each rank and 2.7 kB for each sphere,
/// the largest that LIGGGHTS 3.8.0 took at any moment with 60 to 300,000 grains (src/manual/costs.md).
double expected_memory(prepare::PreparedCase const& prepared, int ranks = 1);

/// Skin of the neighbour lists in grain diameters, which the deck uses.
constexpr double skin_in_diameters = 0.3;

}  // namespace vibrotrough::deck
