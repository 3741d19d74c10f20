#pragma once

#include "theory/quantities.hpp"

#include <string>
#include <vector>

namespace vibrotrough::theory {

/// The values that a quantity may take.
struct Range {
    double low, high;  ///< ends of the range, both included
};

/// Within what a machine may be chosen.
struct DesignLimits {
    double friction;                        ///< mu, given
    Range frequency{5, 60};                 ///< Hz
    Range amplitude{0.0005, 0.015};         ///< m
    Range vibration_angle{0.0873, 1.0472};  ///< rad, within (0, pi/2)
    Range inclination{0, 0};                ///< rad, within (-pi/2, pi/2)
    double most_machine_number = 5;         ///< K: what the structure bears
    double most_throw_number = 3.29;        ///< Gamma: beyond a flight of one cycle landings get irregular
    double least_mass_flow = 0;             ///< kg/s, 0: none; needs a layer
    double gravity = 9.81;                  ///< m/s^2
    double bulk_density = 0, layer_height = 0, layer_width = 0;  ///< kg/m^3, m, m; 0 without a layer
};

/// A machine within the limits and its conveying speed.
struct Design {
    double frequency, amplitude, vibration_angle, inclination;  ///< SI, rad
    double throw_number, machine_number, velocity_efficiency;   ///< Gamma, K and eta of the point mass
    double conveying_speed;                                     ///< m/s
    double mass_flow;                                           ///< kg/s; 0 without a layer
    std::string mode;  ///< letters of the phases in order, e.g. "FPN"
    bool feasible;     ///< all limits are kept; when not, the flow asked for is not reached
    std::vector<std::string> active_limits;  ///< that hold the speed back: "machine_number <= 5" and the like
};

/// The fastest conveying of the plastic point mass within limits: NLopt's ISRES over frequency, amplitude,
/// vibration angle and inclination, with the machine number and throw number as constraints, polished by
/// COBYLA.
///
/// The search is global but random with a fixed seed: another machine within 0.1 % of the speed may exist.
/// The inclination is kept within |tan(alpha)| <= 0.95 mu, beyond which the mass all but runs away.
/// A limit is called active when the optimum lies within 0.1 % of it.
///
/// @throws std::invalid_argument when a limit has no sense
Design fastest_design(DesignLimits const& asked);

}  // namespace vibrotrough::theory
