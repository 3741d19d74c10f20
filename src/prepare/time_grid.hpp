#pragma once

#include "scenario/model/scenario.hpp"

namespace vibrotrough::prepare {

/// How the run is cut into steps.
struct TimeGrid {
    double time_step;          ///< s
    int steps_per_cycle;       ///< a multiple of `phases_per_cycle` and of the frames per cycle
    double rayleigh_fraction;  ///< time step / Rayleigh time of the smallest grain or clump's sphere
    double contact_fraction;   ///< time step / contact time of the smallest grain at `impact_speed`
    double impact_speed;       ///< m/s, the fastest impact reckoned with
};

/// Every cycle is sampled at this many phases.
constexpr int phases_per_cycle = 100;

/// What the time step depends on beside the scenario's numbers.
struct StepLimits {
    double smallest_radius;  ///< m, of the grains or of a clump's spheres
    double drive_speed;      ///< m/s, upper bound of the trough's speed
    int highest_order;       ///< of the drive's harmonics
};

/// Time step: the smallest of what `solver.rayleigh_fraction` says of the Rayleigh time, 10 % of the Hertz
/// contact time, 1/500 of a cycle, 1/50 of the period of the drive's highest harmonic, and what makes the
/// steps per cycle (and per phase and frame) a whole number. Rayleigh time  T_R = pi R sqrt(rho / G) /
/// (0.1631 nu + 0.8766), G = E / (2 (1 + nu))
///   (Li, Xu & Thornton, Powder Technology 160, 2005).
/// Hertz contact  t_H = 2.87 (m*^2 / (R* E*^2 v))^(1/5) of two equal grains
///   (Johnson, Contact Mechanics, 1985, section 11.4), at v = twice the drive's largest speed: a grain that
///   flies at the trough's largest speed against a trough that comes at its largest speed.
/// A block has a linear contact of duration T / block_stiffness instead, and 1/20 of that as its time step.
/// @throws InputError when a cycle would take more than 1e8 steps
TimeGrid choose_time_step(scenario::Scenario const& scenario, StepLimits const& limits);

/// The time step for settling: the same rules at the speed of a free fall from `fall_height` (m), whatever
/// the drive.
double settling_time_step(scenario::Scenario const& scenario, StepLimits const& limits, double fall_height);

/// The plastic contact of a block of mass m, for contacts of duration t_c. Normal force k d + c v, never
/// negative, with k = m / t_c^2 and c = 10 m / t_c, five times the critical damping: a landing dies with the
/// time constant m / c = t_c / 10, the spring gives back 1/100 of its speed, and what it was pressed in
/// relaxes within c / k = 10 t_c. Tangential force min(c v, mu F): damping and friction decay together
/// in a landing, so that its tangential impulse is exactly what Coulomb allows or what stops the slip,
/// whichever is less; a spring instead would give its energy back. The price is a creep of a t_c / 10
/// where a block rests under the acceleration a. See validation/rigid_block.
/// A plate of several spheres has 1.5 times the critical damping (k = 11 m / t_c^2) and a force that may
/// pull: a tilt relaxes ten times as fast, where a plate that leaves tilted would spin and land on its edges.
struct BlockContact {
    double duration;   ///< s
    double stiffness;  ///< N/m, of one of its spheres
    double damping;    ///< 1/s: the damping force is damping * m * v, both ways, of one of its spheres
    bool pulls;        ///< whether the normal force may be negative
};

/// @param spheres  that the block stands on
BlockContact block_contact(scenario::Scenario const& scenario, double mass, int spheres);

}  // namespace vibrotrough::prepare
