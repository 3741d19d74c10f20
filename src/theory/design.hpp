#pragma once

#include "theory/drive_search.hpp"
#include "theory/quantities.hpp"
#include "theory/rolling_layer.hpp"
#include "theory/sensitivity.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::theory {

/// The limits within which a machine may be chosen.
struct DesignLimits {
    double friction;                        ///< mu, a given value
    Range frequency{5, 60};                 ///< Hz
    Range amplitude{0.0005, 0.015};         ///< m
    Range vibration_angle{0.0873, 1.0472};  ///< rad, within (0, pi/2)
    Range inclination{0, 0};                ///< rad, within (-pi/2, pi/2)
    double max_machine_number = 5;          ///< K: what the structure can bear
    double max_throw_number =
        3.29;                  ///< Gamma: landings become irregular when a flight lasts more than one cycle
    double min_mass_flow = 0;  ///< kg/s, 0: no requirement; needs a layer
    double gravity = 9.81;     ///< m/s^2
    double bulk_density = 0, layer_height = 0, layer_width = 0;  ///< kg/m^3, m, m; 0 without a layer
    /// The law of rolling layers; nothing: a point mass. The drive is then kept where the law has been tested
    /// (outside_tested_range()).
    std::optional<RollingLaw> rolling = {};

    /// The drives among which the search may choose.
    DriveSpace space() const;
};

/// A machine within the limits and its conveying speed.
struct Design {
    double frequency, amplitude, vibration_angle, inclination;  ///< SI, rad
    double throw_number, machine_number, velocity_efficiency;   ///< Gamma, K and eta
    double conveying_speed;                                     ///< m/s
    double mass_flow;                                           ///< kg/s; 0 without a layer
    std::string mode;  ///< letters of the phases in order, e.g. "FPN"
    bool feasible;     ///< whether all limits are met; if not, the required mass flow cannot be reached
    /// The limits that restrict the speed, e.g. "machine_number <= 5".
    std::vector<std::string> active_limits;
};

/// The largest |tan(alpha)| / mu that a design uses: beyond it, the speed depends on the last digit of the
/// friction coefficient, and beyond mu it is unbounded.
inline constexpr double max_friction_used = 0.95;

/// The inclination, in rad, at which |tan(alpha)| is 0.95 mu.
double steepest_slope(double friction);

/// The inclinations of a range at which |tan(alpha)| <= 0.95 mu.
/// @throws std::invalid_argument when there are none
Range with_friction_margin(Range inclination, double friction);

/// Finds the machine with the highest conveying speed of the plastic point mass, or of a rolling layer,
/// within the limits, by best_drive().
///
/// Other machines with a speed within 0.1 % of the optimum may exist.
/// The inclination is kept within |tan(alpha)| <= 0.95 mu; beyond this the mass is close to running away.
/// A limit is called active when the optimum lies within 0.1 % of it.
///
/// @throws std::invalid_argument when a limit is out of range
Design fastest_design(DesignLimits const& requested);

/// How eta answers to each input of a design. @param limits  those of the design: friction and law
std::vector<Sensitivity> sensitivities_at(Design const& design, DesignLimits const& limits);

}  // namespace vibrotrough::theory
