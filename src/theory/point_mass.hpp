#pragma once

#include <string>
#include <vector>

namespace vibrotrough::theory {

/// What the mass does relative to the trough during a phase.
enum class PhaseKind {
    positive_slide,                ///< P
    negative_slide,                ///< N
    rest,                          ///< R
    flight,                        ///< F
    positive_slide_after_landing,  ///< P'
    negative_slide_after_landing,  ///< N'
};

/// One phase of the periodic motion; angles are omega t.
struct Phase {
    PhaseKind kind;                ///< what the mass does
    double start;                  ///< rad; the first phase starts in [0, 2 pi)
    double end;                    ///< rad, >= start
    double relative_displacement;  ///< of the mass against the trough, in units of r cos(beta)
};

/// The inputs of Sloot & Kruyt's point mass (Powder Technology 87, 1996, 203-210) with plastic landing.
struct PointMass {
    double throw_number;         ///< Gamma = omega^2 r sin(beta) / (g cos(alpha)), in (0, 1e4]
    double tan_vibration_angle;  ///< tan(beta), in (0, 1e6]
    double tan_inclination = 0;  ///< tan(alpha), uphill positive in the conveying direction, |.| <= 1e6
    double friction;             ///< mu, in [0, 1e6]
};

/// How the long run of a motion ends.
enum class Outcome {
    periodic,     ///< the motion repeats after `period_cycles`
    runs_away,    ///< |tan(alpha)| > mu: gravity outdoes friction in every cycle and the speed grows without
                  ///< bound
    indifferent,  ///< mu = 0 on a level trough: nothing acts along the trough, every speed stays what it is
    unsettled,    ///< no period was found; the efficiency is a mean over the cycles that were followed
};

/// The long run of the motion of a point mass.
struct Motion {
    double velocity_efficiency;  ///< eta = mean relative velocity / (omega r cos(beta)); infinite when it
                                 ///< runs away
    std::string mode;            ///< letters of `phases` in order, e.g. "FPN"; empty when it does not settle
    std::vector<Phase> phases;   ///< one period, starting at take-off, at the first slide without flight
    double flight_number;        ///< duration of the (longest) flight in cycles; 0 without flight
    int period_cycles;           ///< cycles after which the motion repeats; 0 when it does not settle
    bool converged;              ///< the periodic motion was found
    Outcome outcome;             ///< why it converged or not
};

/// "P", "N", "R", "F", "P'" or "N'".
std::string to_string(PhaseKind kind);

/// One line of plain words.
std::string to_string(Outcome outcome);

/// K = omega^2 r / g = Gamma cos(alpha) / sin(beta).
double machine_number(PointMass const& input);

/// The periodic motion of the mass, exact within each phase (no time stepping).
///
/// Model: Sloot & Kruyt (1996): sinusoidal drive X = Y = sin t, rigid point mass, one Coulomb friction
/// coefficient, plastic landing, no side wall, no air. Slides Eqs. 6-11, flight Eqs. 12-16, landing Eqs.
/// 17-18 with the friction impulse limited to what stops the slip. The normal motion does not depend on the
/// tangential one and is solved first; the tangential one is the fixed point of a monotone, non-expanding
/// map of the velocity at take-off, found by safeguarded Newton. A landing where the trough accelerates away
/// faster than gravity (Gamma > 3.297) relaunches at once.
///
/// mu = |tan(alpha)| has many periodic motions: the slowest one is given.
///
/// Error of eta below 1e-9 where rounding is small against friction and the motion is not marginal:
/// 1e-6 max(1, Gamma) < mu tan(beta) < 1e4 and |tan(alpha)| < 0.999 mu. Outside, eta is known to about
/// 1e-15 / (mu tan(beta)), 1e-15 mu tan(beta) and, at |tan(alpha)| = mu, 1e-7.
///
/// @throws std::invalid_argument when an input is out of its range (see PointMass)
/// @throws PhaseError when a phase cannot be solved
Motion solve(PointMass const& input);

}  // namespace vibrotrough::theory
