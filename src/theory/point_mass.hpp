#pragma once

#include <string>
#include <vector>

namespace vibrotrough::theory {

/// The motion of the mass relative to the trough during a phase. The letters make up the name of a mode.
enum class PhaseKind {
    positive_slide,                ///< P: slides in the conveying direction
    negative_slide,                ///< N: slides against the conveying direction
    rest,                          ///< R: moves with the trough
    flight,                        ///< F: has no contact with the trough
    positive_slide_after_landing,  ///< P': a positive slide that starts with a landing
    negative_slide_after_landing,  ///< N': a negative slide that starts with a landing
};

/// One phase of the periodic motion. Times are given as the angle omega t.
struct Phase {
    PhaseKind kind;                ///< what the mass does
    double start;                  ///< rad; the first phase starts in [0, 2 pi)
    double end;                    ///< rad, >= start
    double relative_displacement;  ///< of the mass relative to the trough, in r cos(beta)
};

inline constexpr double largest_throw_number = 100;  ///< No trough comes near it.

/// The inputs of Sloot & Kruyt's point mass (Powder Technology 87, 1996, 203-210) with perfectly plastic
/// landing.
struct PointMass {
    double throw_number;         ///< Gamma = omega^2 r sin(beta) / (g cos(alpha)), in (0, 100]
    double tan_vibration_angle;  ///< tan(beta), in (0, 1e6]
    double tan_inclination = 0;  ///< tan(alpha), uphill positive in the conveying direction, |.| <= 1e6
    double friction;             ///< mu, 0 or in [1e-6, 1e6]
};

/// What the motion does in the long run.
enum class Outcome {
    periodic,     ///< the motion repeats after `period_cycles`
    runs_away,    ///< |tan(alpha)| > mu: gravity exceeds friction in every cycle and the speed grows without
                  ///< bound
    indifferent,  ///< mu = 0 on a level trough: no force acts along the trough, so that any speed persists
    unsettled,    ///< no period was found; the efficiency is a mean over the simulated cycles
};

/// The long run of the motion of a point mass.
struct Motion {
    double velocity_efficiency;  ///< eta = mean relative velocity / (omega r cos(beta)); infinite when the
                                 ///< mass runs away
    std::string mode;            ///< letters of `phases` in order, e.g. "FPN"; empty if not periodic
    /// One period, starting at take-off, or at the first slide if there is no flight.
    std::vector<Phase> phases;
    double flight_number;  ///< duration of the longest flight in cycles; 0 if there is no flight
    int period_cycles;     ///< cycles after which the motion repeats; 0 if not periodic
    bool converged;        ///< whether a periodic motion was found
    Outcome outcome;       ///< why it converged or why not
};

/// "P", "N", "R", "F", "P'" or "N'".
std::string to_string(PhaseKind kind);

/// A sentence in plain words.
std::string to_string(Outcome outcome);

/// K = omega^2 r / g = Gamma cos(alpha) / sin(beta).
double machine_number(PointMass const& input);

/// Solves for the periodic motion of the mass, exactly within each phase (without time stepping).
///
/// Model (Sloot & Kruyt 1996): sinusoidal drive X = Y = sin t, rigid point mass, one Coulomb friction
/// coefficient, perfectly plastic landing, no side walls, no air drag. Slides follow Eqs. 6-11, flights Eqs.
/// 12-16, landings Eqs. 17-18 with the friction impulse limited to the value that stops the slip. The normal
/// motion does not depend on the tangential motion and is solved first. The tangential motion is the fixed
/// point of a monotone, non-expanding map of the velocity at take-off, found by a safeguarded Newton method.
/// If the mass lands while the trough accelerates downwards faster than gravity (Gamma > 3.297), it takes off
/// again at once.
///
/// For mu = |tan(alpha)| there are many periodic motions: the slowest one is given.
///
/// The error of eta is below 1e-9 if rounding errors are small compared with friction and the motion is not
/// marginal: 1e-6 max(1, Gamma) < mu tan(beta) < 1e4 and |tan(alpha)| < 0.999 mu. Outside this range, eta is
/// known to about 1e-15 / (mu tan(beta)), 1e-15 mu tan(beta) and, at |tan(alpha)| = mu, 1e-7.
///
/// @throws std::invalid_argument when an input is out of range (see PointMass)
/// @throws PhaseError when a phase cannot be solved
Motion solve(PointMass const& input);

}  // namespace vibrotrough::theory
