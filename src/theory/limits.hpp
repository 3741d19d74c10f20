#pragma once

#include "theory/point_mass.hpp"

#include <optional>

// Results of Sloot & Kruyt (1996) in closed form or from the root of one equation.
namespace vibrotrough::theory {

/// The throw number at which a flight that starts from contact lasts n cycles (Eq. 15):
/// Gamma = sqrt(((cos 2 pi n + 2 pi^2 n^2 - 1) / (2 pi n - sin 2 pi n))^2 + 1), n in [0, 1000].
double throw_number_of_flight(double n);

/// The best throw number and what is reached there.
struct Optimum {
    double throw_number;         ///< Gamma
    double velocity_efficiency;  ///< eta
};

/// The throw number in [0.1, sqrt(1 + pi^2)] at which eta is largest (Eqs. 15 and 19). It depends on mu
/// tan(beta) and tan(alpha). It is found by a scan and Brent's method to 1e-7.
/// @throws std::invalid_argument as solve() does, and when the mass runs away
Optimum best_throw_number(double tan_vibration_angle, double tan_inclination, double friction);

/// The limit of best_throw_number() for beta -> 0 at any alpha: the mass lands at omega t = 2 pi, where the
/// trough is fastest, so that with D = 2 pi - delta_F: tan(delta_F) = D / (D^2/2 - 1) and Gamma = 1 /
/// sin(delta_F). The value is 2.975.
double best_throw_number_small_angle();

/// The PN mode in closed form (Eq. 20).
struct PnMotion {
    double positive_start, positive_end;  ///< omega t; the negative slide fills the rest of the cycle
    double positive_displacement, negative_displacement;  ///< r cos(beta)
    double velocity_efficiency;                           ///< eta
};

/// Eq. 20: C = 2 pi / (1 - sin d1 / sin d3), e_P = C + d_P, sin(d_P + C/2) = (C - 2 pi) sin d3 / (2
/// sin(C/2)). Returns std::nullopt when the mode is not PN: Gamma > 1, or a slide cannot start when the other
/// one ends, or mu tan(beta) >= 1.
std::optional<PnMotion> pn_motion(PointMass const& input);

/// eta for beta -> 0, K -> infinity, Gamma <= 1 (Eq. 21): - sin(pi tan(alpha) / (2 mu)), antisymmetric in
/// alpha. Range: |tan(alpha)| <= mu, mu > 0. @throws std::invalid_argument outside this range
double small_angle_efficiency(double tan_inclination, double friction);

/// The machine number above which the mode is PN at beta = 0, alpha = 0: mu sqrt(1 + pi^2/4). Below it, the
/// mass rests between the slides. (For mu = 0.35 this gives 0.652; the paper reads 0.67 from Fig. 7.)
double pn_machine_number(double friction);

/// All of these for one trough.
struct Limits {
    double whole_cycle_throw_number;       ///< of a flight that lasts one cycle, sqrt(1 + pi^2) (Eq. 15)
    double whole_cycle_efficiency;         ///< eta there, for a small vibration angle, level
    double best_throw_number_small_angle;  ///< Eq. 19
    Optimum best;                          ///< for this vibration angle, inclination and friction
    double small_angle_efficiency;         ///< Eq. 21
    double pn_machine_number;              ///< from which the mode is PN, beta = 0, level
};

/// @throws std::invalid_argument as best_throw_number() and small_angle_efficiency()
Limits limits(double tan_vibration_angle, double tan_inclination, double friction);

}  // namespace vibrotrough::theory
