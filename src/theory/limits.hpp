#pragma once

#include "theory/point_mass.hpp"

#include <optional>

// Results of Sloot & Kruyt (1996) in closed form or by a root of one equation.
namespace vibrotrough::theory {

/// Throw number at which a plastic flight lasts n cycles (Eq. 15):
/// Gamma = sqrt(((cos 2 pi n + 2 pi^2 n^2 - 1) / (2 pi n - sin 2 pi n))^2 + 1), n in [0, 1000].
double throw_number_of_flight(double n);

/// The best throw number and what is reached there.
struct Optimum {
    double throw_number;         ///< Gamma
    double velocity_efficiency;  ///< eta
};

/// The throw number in [0.1, sqrt(1 + pi^2)] at which eta is largest (Eqs. 15 and 19). It moves with mu
/// tan(beta) and tan(alpha). Located by a scan and Brent's method to 1e-7.
/// @throws std::invalid_argument as solve(); also when the mass runs away
Optimum best_throw_number(double tan_vibration_angle, double tan_inclination, double friction);

/// Its limit for beta -> 0, alpha any: the landing is at 2 pi, where the trough is fastest, so that with
/// D = 2 pi - delta_F: tan(delta_F) = D / (D^2/2 - 1) and Gamma = 1 / sin(delta_F). 2.975.
double best_throw_number_small_angle();

/// The PN mode in closed form (Eq. 20).
struct PnMotion {
    double positive_start, positive_end;  ///< omega t; the negative slide fills the rest of the cycle
    double positive_displacement, negative_displacement;  ///< r cos(beta)
    double velocity_efficiency;                           ///< eta
};

/// Eq. 20: C = 2 pi / (1 - sin d1 / sin d3), e_P = C + d_P, sin(d_P + C/2) = (C - 2 pi) sin d3 / (2
/// sin(C/2)). Nothing where the mode is not PN: Gamma > 1, or a slide could not start when the other ends, or
/// mu tan(beta) >= 1.
std::optional<PnMotion> pn_motion(PointMass const& input);

/// eta for beta -> 0, K -> infinity, Gamma <= 1 (Eq. 21): - sin(pi tan(alpha) / (2 mu)), antisymmetric in
/// alpha. Range: |tan(alpha)| <= mu, mu > 0. @throws std::invalid_argument outside
double small_angle_efficiency(double tan_inclination, double friction);

/// Machine number above which the mode is PN at beta = 0, alpha = 0: mu sqrt(1 + pi^2/4). Below, the mass
/// rests between slides. (The paper reads 0.67 at mu = 0.35 off Fig. 7; this gives 0.652.)
double pn_machine_number(double friction);

}  // namespace vibrotrough::theory
