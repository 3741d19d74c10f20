#pragma once

#include "theory/conveyor.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::theory {

/// The state of a motion at one time. Lengths are in r cos(beta) along the trough and in r sin(beta) normal
/// to it, time is in 1/omega.
struct TraceSample {
    double t;          ///< rad
    PhaseKind kind;    ///< what the mass does
    double trough_vx;  ///< velocities in the frame of the ground: along in omega r cos(beta), normal in omega
                       ///< r sin(beta)
    double trough_vy;  ///< of the trough, normal
    double mass_vx;    ///< of the mass, along
    double mass_vy;    ///< of the mass, normal
    double trough_ax, trough_ay;  ///< accelerations, in omega^2 r cos(beta) and omega^2 r sin(beta)
    double displacement;          ///< of the mass relative to the trough since the start of the trace
    double gap;                   ///< 0 in contact
    double normal_force;  ///< of the trough on the mass, per unit mass, in omega^2 r sin(beta); impacts not
                          ///< included
    double tangential_force;  ///< the same along the trough, in omega^2 r cos(beta)
};

/// Samples a motion at `count` >= 2 equally spaced times over its pieces, both ends included.
/// @throws std::invalid_argument when the motion has no pieces
std::vector<TraceSample> trace(ConveyorMotion const& motion, int count);

/// The motion at any time t (rad, finite). The pieces are repeated before and after their time span; the
/// displacement grows from period to period.
/// @throws std::invalid_argument when the motion has no pieces
TraceSample sample(ConveyorMotion const& motion, double t);

/// A number of a trace and what its column is called: as it is, and after in_si_units().
struct TraceColumn {
    char const* name;            ///< of the dimensionless number
    char const* si_name;         ///< of the number in SI units
    double TraceSample::*value;  ///< where it is in a sample
};

/// All numbers of a trace in the order of a table; `kind` is apart from them.
std::vector<TraceColumn> const& trace_columns();

/// Energies per unit mass and cycle in (omega r)^2; `beta` weighs the two directions.
struct EnergyBalance {
    double trough_work;    ///< work of the trough on the mass by normal force, friction and impacts
    double friction_loss;  ///< during slides
    double impact_loss;    ///< kinetic energy of the relative motion lost in impacts, normal and tangential
    double drag_loss;      ///< by air drag
    double lift;           ///< gain of potential energy; negative when conveyed downhill
    /// The energy that is not accounted for: zero for a periodic motion up to the quadrature error of 1e-12.
    double residual() const { return trough_work - friction_loss - impact_loss - drag_loss - lift; }
};

/// The energies of a motion. @throws std::invalid_argument when it has no pieces
EnergyBalance energy_balance(ConveyorMotion const& motion);

/// The machine to which the dimensionless numbers belong.
struct Machine {
    double amplitude;         ///< r, m, in the direction of vibration
    double gravity = 9.81;    ///< m/s^2
    double bulk_density = 0;  ///< kg/m^3; 0: mass flow is not computed
    double layer_height = 0;  ///< m
    double layer_width = 0;   ///< m
};

/// The quantities that an engineer needs, in SI units.
struct EngineerQuantities {
    double frequency;          ///< Hz
    double angular_frequency;  ///< rad/s
    double conveying_speed;    ///< m/s, eta omega r cos(beta)
    double stroke;             ///< m, 2 r
    /// kg/s, bulk density * height * width * speed; none unless all three of the layer are known.
    std::optional<double> mass_flow;
    /// W/m^2 of trough, mean_power * bulk density * height; none unless both of the layer are known.
    std::optional<double> power_per_area;
    /// m/s, largest speed of the mass relative to the trough at an impact (grain damage).
    double impact_speed;
    double normal_impact_speed;                             ///< m/s, largest normal component of that speed
    double impacts_per_cycle;                               ///< mean number of impacts
    double friction_energy;                                 ///< J/kg per cycle (wear)
    double impact_energy;                                   ///< J/kg per cycle
    double trough_work;                                     ///< J/kg per cycle
    double mean_power;                                      ///< W/kg
    double largest_normal_force, largest_tangential_force;  ///< N/kg, between impacts
    double largest_impulse;                                 ///< N s/kg, normal impulse of one impact
};

/// omega from Gamma and r: omega^2 = Gamma g cos(alpha) / (r sin(beta)).
double angular_frequency(PointMass const& point, Machine const& machine);

/// What an engineer needs of a motion in a search: two of EngineerQuantities.
struct ImpactAndPower {
    double impact_speed;  ///< m/s
    double mean_power;    ///< W/kg, from the energy that is lost and gained by lifting
};

/// In a thirtieth of the time of engineer_quantities(). @throws std::invalid_argument as that
ImpactAndPower impact_and_power(ConveyorMotion const& motion, Machine const& machine);

/// The trace of a machine: s, m, m/s, m/s^2 and N/kg in the places of the dimensionless numbers.
std::vector<TraceSample> in_si_units(std::vector<TraceSample> samples, PointMass const& point,
                                     Machine const& machine);

/// A number with its name and unit.
struct NamedQuantity {
    char const* name;  ///< of the quantity
    char const* unit;  ///< in which it is given
    double value;      ///< in that unit
};

/// The quantities in the order of a table. Some are there twice in different units (Hz and turns per minute,
/// kg/s and t/h). Left out are the angular frequency and what is not known.
std::vector<NamedQuantity> listed(EngineerQuantities const& quantities);

/// @throws std::invalid_argument when the motion has no pieces (it runs away) or the machine has no sense
EngineerQuantities engineer_quantities(ConveyorMotion const& motion, Machine const& machine);

}  // namespace vibrotrough::theory
