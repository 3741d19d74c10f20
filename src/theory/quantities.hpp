#pragma once

#include "theory/conveyor.hpp"

#include <vector>

namespace vibrotrough::theory {

/// What a motion is at one time. Lengths along in r cos(beta), normal in r sin(beta), time in 1/omega.
struct TraceSample {
    double t;                     ///< rad
    PhaseKind kind;               ///< what the mass does
    double trough_vx, trough_vy;  ///< velocity in the frame of the ground
    double mass_vx, mass_vy;      ///< likewise of the mass
    double trough_ax, trough_ay;  ///< accelerations, in omega^2 r cos(beta) and omega^2 r sin(beta)
    double displacement;          ///< of the mass against the trough since the start of the trace
    double gap;                   ///< 0 in contact
    double normal_force;  ///< of the trough on the mass, per mass, in omega^2 r sin(beta); without impacts
    double tangential_force;  ///< likewise along, in omega^2 r cos(beta)
};

/// Samples of the pieces of a motion at `count` >= 2 equal steps over them, both ends included.
/// @throws std::invalid_argument when the motion has no pieces
std::vector<TraceSample> trace(ConveyorMotion const& motion, int count);

/// The motion at any time t (rad, finite), repeated before and after the pieces; the displacement grows from
/// period to period.
/// @throws std::invalid_argument when the motion has no pieces
TraceSample sample(ConveyorMotion const& motion, double t);

/// Energies per unit mass and cycle in (omega r)^2; `beta` weighs the two directions.
struct EnergyBalance {
    double trough_work;    ///< by normal force, friction and impacts on the mass
    double friction_loss;  ///< in slides
    double impact_loss;    ///< of the relative motion, normal and along
    double drag_loss;      ///< to the air
    double lift;           ///< into height; negative when conveyed downhill
    /// Zero for a periodic motion: its error is that of the quadrature, 1e-12.
    double defect() const { return trough_work - friction_loss - impact_loss - drag_loss - lift; }
};

/// The energies of a motion. @throws std::invalid_argument when it has no pieces
EnergyBalance energy_balance(ConveyorMotion const& motion);

/// The machine behind the dimensionless numbers.
struct Machine {
    double amplitude;         ///< r, m, in the direction of vibration
    double gravity = 9.81;    ///< m/s^2
    double bulk_density = 0;  ///< kg/m^3; 0: no layer
    double layer_height = 0;  ///< m
    double layer_width = 0;   ///< m
};

/// What an engineer asks, in SI units.
struct EngineerQuantities {
    double frequency;            ///< Hz
    double angular_frequency;    ///< rad/s
    double conveying_speed;      ///< m/s, eta omega r cos(beta)
    double mass_flow;            ///< kg/s, bulk density * height * width * speed; 0 without a layer
    double impact_speed;         ///< m/s, largest speed of the mass against the trough at an impact: damage
    double normal_impact_speed;  ///< m/s, its normal part
    double impacts_per_cycle;    ///< mean number of impacts
    double friction_energy;      ///< J/kg per cycle: wear
    double impact_energy;        ///< J/kg per cycle
    double trough_work;          ///< J/kg per cycle
    double mean_power;           ///< W/kg
    double largest_normal_force, largest_tangential_force;  ///< N/kg, between impacts
    double largest_impulse;                                 ///< N s/kg, normal, of one impact
};

/// omega from Gamma and r: omega^2 = Gamma g cos(alpha) / (r sin(beta)).
double angular_frequency(PointMass const& point, Machine const& machine);

/// @throws std::invalid_argument when the motion has no pieces (it runs away) or the machine has no sense
EngineerQuantities engineer_quantities(ConveyorMotion const& motion, Machine const& machine);

}  // namespace vibrotrough::theory
