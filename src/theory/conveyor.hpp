#pragma once

#include "theory/point_mass.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::theory {

/// A harmonic of the trough's acceleration that is added to the fundamental -sin t (Eq. 22): -amplitude
/// sin(order t + phase), in units of the acceleration amplitude of the fundamental in the same direction.
struct Harmonic {
    int order;         ///< 1 to 100
    double amplitude;  ///< of the acceleration, as a fraction of the fundamental's
    double phase = 0;  ///< rad
};

/// The largest normal restitution coefficient that the theory takes.
inline constexpr double largest_restitution = 0.95;

/// The velocity with which a flight starts when it interrupts an N' slide (a backward slide after a landing).
enum class FlightStart {
    actual_velocity,       ///< the mass keeps the velocity it has (this is the physics)
    trough_velocity_rule,  ///< V_F = cos(delta_F): not physical; only reproduces the columns e > 0 of Table 1
};

/// All parameters of the general point-mass model. The defaults describe Sloot & Kruyt's point mass with
/// perfectly plastic landing.
///
/// Not covered: a layer with internal motion, a trough whose motion depends on the load, and infinite
/// sequences of ever smaller rebounds (Zeno behaviour) below `slowest_rebound`.
struct Conveyor {
    PointMass point;                ///< its `friction` is the kinetic friction coefficient mu
    double static_friction = 0;     ///< mu_s >= mu (Nedderman & Harding); 0: equal to the kinetic one
    double restitution = 0;         ///< normal restitution coefficient e in [0, 0.95] (Eq. 23); the friction
                                    ///< impulse is mu (1 + e) times the approach velocity
    double slowest_rebound = 1e-6;  ///< rebounds slower than this count as contact, in omega r sin(beta)
    /// Friction coefficient used instead of mu for the impulse of a landing (Eqs. 17, 18), >= 0. This
    /// parameter is not in the paper; validation/why_theory_fails describes what it can and cannot explain
    /// about layers.
    std::optional<double> landing_friction = {};
    double air_drag = 0;  ///< kappa, 0 or in [1e-8, 1000]: the drag force is m omega kappa times the velocity
                          ///< of the mass; the air is at rest
    double along_ratio = 1;             ///< elliptical drive: X = along_ratio sin(t + along_phase), Y = sin t
    double along_phase = 0;             ///< rad
    std::vector<Harmonic> along = {};   ///< harmonics of the acceleration of X
    std::vector<Harmonic> normal = {};  ///< and of Y
    double wall_friction = 0;  ///< friction coefficient between the layer and the two side walls, >= 0
    double wall_pressure_ratio = 0.5;  ///< Janssen's ratio k of horizontal to vertical stress, in [0, 1]
    double height_over_width = 0;      ///< H / W of the layer, >= 0
    FlightStart flight_start = FlightStart::actual_velocity;  ///< velocity with which a flight starts
};

/// Friction coefficients that account for the floor and the side walls together.
struct EffectiveFriction {
    double kinetic_friction;  ///< while the mass slides
    double static_friction;   ///< while it rests
    double landing_friction;  ///< in the impulse of a landing
};

/// Includes the friction of the side walls by means of Janssen's stress ratio. The walls carry the horizontal
/// stress k sigma_v, with sigma_v = N(t) z / H at depth z. While the layer slips along the trough, the wall
/// friction acts along the trough, so that it does not support any weight and Janssen's saturation does not
/// occur. Two walls therefore contribute k wall_friction H / W times the normal force, which is added to mu.
/// This holds in contact and during impacts; in flight the walls have no effect.
EffectiveFriction effective_friction(Conveyor const& conveyor);

/// An impact at the end of a flight. Velocities are relative to the trough: along it in omega r cos(beta),
/// normal to it in omega r sin(beta).
struct Impact {
    double t;                          ///< rad
    double approach, rebound;          ///< normal velocities before and after, both >= 0
    double along_before, along_after;  ///< along the trough, signed
};

namespace detail {
class Forces;  // see detail/forces.hpp
}

/// A phase with all that is needed to evaluate the motion at any time within it.
struct Piece {
    PhaseKind kind;         ///< what the mass does
    double start, end;      ///< rad
    double along_velocity;  ///< absolute, at start, in omega r cos(beta)
    double gap, gap_rate;   ///< at start, in r sin(beta), omega r sin(beta); zero in contact
    double displacement;    ///< relative, in r cos(beta)
};

/// The long run of a motion, with what is needed to evaluate it at any time.
struct ConveyorMotion {
    Motion motion;          ///< as for a PointMass: eta, mode, phases, period
    double half_width = 0;  ///< of the 95 % confidence interval of eta if no period was found; 0 if periodic
    int cycles_followed = 0;      ///< number of cycles averaged over if no period was found
    std::vector<Piece> pieces;    ///< of one period, or of the (last) cycles followed if there is none
    std::vector<Impact> impacts;  ///< in the same time span as `pieces`
    std::shared_ptr<detail::Forces const> forces;  ///< on the mass, from which all within a piece follows
};

/// The long-term motion that develops from a start at rest on the trough at t = 0. This is the answer of
/// EfficiencySolver to the last bit, with its phases. Each phase is solved in closed form; its ends are zeros
/// of sums of sines, all of which are found.
///
/// The normal motion is followed until it repeats after 1 to 64 cycles; the motion along the trough is then
/// the fixed point of a map of one velocity. Where there is no period, the mean of eta is given with the
/// half-width of its 95 % confidence interval from 20 batches of 16 to 128 cycles, and the phases of the same
/// cycles.
///
/// If static friction exceeds kinetic friction, several periodic motions can exist: the one reached from rest
/// is given.
///
/// @throws std::invalid_argument when an input is out of range
/// @throws PhaseError when a phase cannot be solved
ConveyorMotion solve(Conveyor const& conveyor);

}  // namespace vibrotrough::theory
