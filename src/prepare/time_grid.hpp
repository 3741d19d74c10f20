#pragma once

#include "scenario/model/scenario.hpp"

namespace vibrotrough::prepare {

/// How a run is divided into time steps.
struct TimeGrid {
    double time_step;          ///< s
    int steps_per_cycle;       ///< a multiple of `phases_per_cycle` and of the frames per cycle
    double rayleigh_fraction;  ///< time step / Rayleigh time of the smallest sphere
    double contact_fraction;   ///< time step / contact time of the smallest grain at `impact_speed`
    double impact_speed;       ///< m/s, the fastest impact that is expected
};

/// The same cycle with another number of steps.
TimeGrid with_steps(TimeGrid grid, int steps_per_cycle);

/// Number of phases of a cycle at which the run is sampled.
constexpr int phases_per_cycle = 100;

/// What the time step depends on in addition to the scenario.
struct StepLimits {
    double smallest_radius;  ///< m, of the grains or of the spheres of a clump
    double drive_speed;      ///< m/s, upper bound of the speed of the trough
    int highest_order;       ///< of the harmonics of the drive
};

/// The time step of the run. It is the largest that is at most `solver.rayleigh_fraction` of the Rayleigh
/// time, 10 % of the Hertz contact time, 1/500 of a cycle and 1/50 of the period of the drive's highest
/// harmonic, and that gives a whole number of steps per cycle, phase and frame.
/// - Rayleigh time T_R = pi R sqrt(rho / G) / (0.1631 nu + 0.8766), G = E / (2 (1 + nu)) (Li, Xu & Thornton,
/// Powder
///   Technology 160, 2005).
/// - Hertz contact time t_H = 2.87 (m*^2 / (R* E*^2 v))^(1/5) of two equal grains (Johnson, Contact
/// Mechanics, 1985,
///   section 11.4). v is twice the largest speed of the drive: a grain that flies at this speed meets the
///   trough when the trough approaches it at the same speed.
///
/// With another `engine.contact` the contact time is that of its class in prepare/contact.cpp, of two equal
/// grains at the same speed v, with the lower restitution.
///
/// A block has a linear contact of duration T / block_stiffness instead and 1/20 of that as its time step.
/// @throws core::InputError when a cycle would take more than 1e8 steps
TimeGrid choose_time_step(scenario::Scenario const& scenario, StepLimits const& limits);

/// Speed of a grain after a free fall from `fall_height` (m), m/s. @param gravity  m/s^2
double settling_speed(double fall_height, double gravity);

/// The time step for settling, s. The limits are the Rayleigh time and the contact time at the speed of
/// a free fall from `fall_height` (m); the drive does not matter.
double settling_time_step(scenario::Scenario const& scenario, StepLimits const& limits, double fall_height);

/// The plastic contact of a block of mass m, for contacts of duration t_c.
///
/// The normal force k d + c v is never negative. With k = m / t_c^2 and c = 10 m / t_c, which is five times
/// the critical damping, the speed of a landing decays with the time constant m / c = t_c / 10, the spring
/// returns 1/100 of it, and the overlap relaxes within c / k = 10 t_c.
///
/// The tangential force is min(c v, mu F). Damping and friction decay together during a landing, so its
/// tangential impulse is the smaller of what Coulomb friction allows and what stops the slip. A tangential
/// spring would return its energy instead. The price is that a block at rest under the acceleration a creeps
/// with the speed a t_c / 10. See validation/history.
///
/// A plate of several spheres has 1.5 times the critical damping (k = 11 m / t_c^2) and a normal force that
/// may be attractive. A tilt then relaxes ten times as fast; a plate that leaves the trough tilted would spin
/// and land on its edges.
struct BlockContact {
    double duration;   ///< s
    double stiffness;  ///< N/m, of one sphere of the block
    double damping;    ///< 1/s; the damping force of one sphere, normal and tangential, is damping * m * v
    bool pulls;        ///< whether the normal force may be negative
};

/// The contact of a block of this mass.
/// @param mass     kg
/// @param spheres  number of spheres on which the block rests
BlockContact block_contact(scenario::Scenario const& scenario, double mass, int spheres);

}  // namespace vibrotrough::prepare
