#pragma once

#include "theory/point_mass.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::theory {

/// A part of the trough's acceleration beside -sin t (Eq. 22): - amplitude sin(order t + phase), in units of
/// the fundamental's acceleration in its direction.
struct Harmonic {
    int order;         ///< 1 to 1000
    double amplitude;  ///< of acceleration
    double phase = 0;  ///< rad
};

/// How a flight begins that interrupts an N' slide.
enum class FlightStart {
    actual_velocity,       ///< with the velocity the mass has: the physics
    trough_velocity_rule,  ///< V_F = cos(delta_F): not physics; reproduces the e > 0 columns of Table 1 only
};

/// Everything that the point-mass theory of this room knows. The defaults are Sloot & Kruyt's plastic point
/// mass.
///
/// Not for a layer with inner motion, a trough that reacts to the load, or Zeno motions slower than
/// `slowest_rebound`.
struct Conveyor {
    PointMass point;                ///< `friction` is the kinetic coefficient mu
    double static_friction = 0;     ///< mu_s >= mu (Nedderman & Harding); 0: the same as kinetic
    double restitution = 0;         ///< e in [0, 1), normal (Eq. 23): friction impulse with mu (1 + e)
    double slowest_rebound = 1e-6;  ///< slower rebounds are contact, in omega r sin(beta)
    /// Instead of mu in the impulse of a landing (Eqs. 17, 18), >= 0. Not in the paper; what it explains of
    /// layers and what it does not is in validation/why_theory_fails.
    std::optional<double> landing_friction;
    double air_drag = 0;     ///< kappa >= 0: drag force = m omega kappa times velocity, air at rest
    double along_ratio = 1;  ///< elliptical drive: X = along_ratio sin(t + along_phase), Y = sin t
    double along_phase = 0;  ///< rad
    std::vector<Harmonic> along, normal;  ///< further parts of the acceleration of X and of Y
    double wall_friction = 0;             ///< of the layer on the two side walls, >= 0
    double wall_pressure_ratio = 0.5;     ///< Janssen's k: horizontal over vertical stress, in [0, 1]
    double height_over_width = 0;         ///< of the layer, >= 0
    FlightStart flight_start = FlightStart::actual_velocity;  ///< velocity with which a flight starts
};

/// Friction coefficients that stand for floor and walls together.
struct EffectiveFriction {
    double kinetic, standing, landing;  ///< while slipping, at rest, and in the impulse of a landing
};

/// Side walls by Janssen's stress ratio: the walls carry the horizontal stress k sigma_v, sigma_v = N(t) z /
/// H at depth z. While the layer slips along the trough, wall friction points along the trough, so none of it
/// carries weight and Janssen's saturation does not occur: two walls give k wall_friction H / W times the
/// normal force, and this adds to mu. Holds in contact and in impacts; in flight the layer is loose and free.
EffectiveFriction effective_friction(Conveyor const& conveyor);

/// An impact at the end of a flight; velocities relative to the trough, along in omega r cos(beta), normal in
/// omega r sin(beta).
struct Impact {
    double t;                          ///< rad
    double approach, rebound;          ///< normal, both >= 0
    double along_before, along_after;  ///< along the trough, signed
};

class ConveyorModel;  // the analytic phases; see conveyor_model.hpp

/// A phase with all that is needed to evaluate it at any time within.
struct Piece {
    PhaseKind kind;         ///< what the mass does
    double start, end;      ///< rad
    double along_velocity;  ///< absolute, at start, in omega r cos(beta)
    double gap, gap_rate;   ///< at start, in r sin(beta), omega r sin(beta); zero in contact
    double displacement;    ///< relative, in r cos(beta)
};

/// The long run of a motion, with what is needed to evaluate it at any time.
struct ConveyorMotion {
    Motion motion;                ///< as solve(): eta, mode, phases, period
    double half_width = 0;        ///< of eta at 95 % confidence when there is no period; 0 when periodic
    int cycles_followed = 0;      ///< cycles that the mean is over, without a period
    std::vector<Piece> pieces;    ///< of one period (of the cycles that were followed last, without a period)
    std::vector<Impact> impacts;  ///< in the same time
    std::shared_ptr<ConveyorModel const> model;  ///< evaluates the pieces
};

/// The long run of the motion that starts at rest. Analytic within each phase; the ends of phases are found
/// by steps that are certified to pass no zero, so no short phase is overlooked.
///
/// The normal motion is repeated until its state at the start of a cycle returns after 1 to 64 cycles; then
/// the motion along the trough is the fixed point of a map of one velocity. Two periods in a row must agree
/// to 1e-9, because long chains of rebounds amplify rounding. When nothing returns within 3000 cycles, the
/// mean over them is given with a half-width from 20 batches (Student's t).
///
/// With static above kinetic friction more than one motion can be periodic: the one reached from rest is
/// given.
///
/// @throws std::invalid_argument when an input is out of its range
/// @throws PhaseError when a phase cannot be solved
ConveyorMotion solve(Conveyor const& conveyor);

}  // namespace vibrotrough::theory
