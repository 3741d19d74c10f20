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
    PhaseKind kind;
    double start;                  ///< rad; the first phase starts in [0, 2 pi)
    double end;                    ///< rad, >= start
    double relative_displacement;  ///< of the mass against the trough, in units of r cos(beta)
};

/// The inputs of Sloot & Kruyt's point mass (Powder Technology 87, 1996, 203-210) with plastic landing.
struct PointMass {
    double throw_number;         ///< Gamma = omega^2 r sin(beta) / (g cos(alpha)), > 0
    double tan_vibration_angle;  ///< tan(beta), > 0
    double tan_inclination = 0;  ///< tan(alpha), uphill positive in the conveying direction
    double friction;             ///< mu, >= 0
};

struct Motion {
    double velocity_efficiency;  ///< eta = mean relative velocity / (omega r cos(beta))
    std::string mode;            ///< letters of `phases` in order, e.g. "FPN"
    std::vector<Phase> phases;   ///< one period, starting at take-off, at the first slide without flight
    double flight_number;        ///< duration of the (longest) flight in cycles; 0 without flight
    int period_cycles;           ///< cycles after which the motion repeats; 0 when it does not settle
    bool converged;              ///< the periodic motion was found
};

/// "P", "N", "R", "F", "P'" or "N'".
std::string to_string(PhaseKind kind);

/// K = omega^2 r / g = Gamma cos(alpha) / sin(beta).
double machine_number(PointMass const& input);

/// The periodic motion of the mass.
/// @throws std::invalid_argument when an input is out of its range
Motion solve(PointMass const& input);

}  // namespace vibrotrough::theory
