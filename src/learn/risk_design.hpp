#pragma once

#include "theory/design.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// What a design is to be best at.
enum class Objective {
    fastest,               ///< the highest speed that is reached at the stated confidence
    gentlest_landing,      ///< the lowest speed of an impact on the trough
    least_machine_number,  ///< the least load of the structure
    least_power,           ///< the least power that the trough gives to the material
};

/// What is known and wanted of a trough. The friction is not known exactly, and the theory is not exact.
struct DesignTask {
    theory::DesignLimits
        limits;       ///< of the drive; its mass flow, friction, bulk density, height and width are not used
    double friction;  ///< median
    double friction_sd;         ///< standard uncertainty of the friction, >= 0
    double discrepancy = 0.05;  ///< standard deviation of the theory's error, in velocity efficiency, >= 0
    double bulk_density;        ///< kg/m^3, > 0
    double width;               ///< m, of the trough, > 0
    double length = 0;          ///< m, of the trough, for the power; 0 when it is not known
    double mass_flow;           ///< kg/s, that is to be reached, > 0
    theory::Range depth{0.002, 0.1};      ///< m, of the layer
    std::optional<double> landing_speed;  ///< m/s, largest speed of an impact on the trough
    double confidence = 0.95;  ///< probability with which the mass flow is to be reached, in [0.5, 0.999]
    Objective objective = Objective::fastest;  ///< what to be best at
};

/// A machine for a task, and how sure it is.
struct RiskDesign {
    theory::Design machine;      ///< at the median of the friction
    double depth;                ///< m, of the layer that carries the mass flow at the stated confidence
    double sure_speed;           ///< m/s, reached with the stated confidence
    double low_flow, high_flow;  ///< kg/s, central 95 % interval of the mass flow at that depth
    double median_flow;          ///< kg/s
    double probability;          ///< that the mass flow is reached
    double
        landing_speed;  ///< m/s, largest speed of an impact at the median of the friction; 0 without flight
    std::optional<double> power;  ///< W, given to the material; none without a length
    bool feasible;  ///< whether the mass flow can be reached within the limits at the stated confidence
    std::vector<std::string> active_limits;  ///< what holds it back
    std::vector<std::string> warnings;       ///< where the theory alone is known to be wrong
};

/// Finds the drive and the depth of the layer that carry a mass flow with a stated probability, by the theory
/// of the point mass.
///
/// The speed is uncertain in two ways: the friction is distributed normally about its median (cut at 0.01),
/// and the theory's efficiency is off by a normal error. The speed that is reached with the stated confidence
/// is the quantile of this distribution. The drive is searched for by NLopt (ISRES, then COBYLA); a design
/// that cannot reach the mass flow at the largest depth is the fastest one instead.
///
/// @throws std::invalid_argument when a limit is out of range
RiskDesign design_with_risk(DesignTask const& task);

/// How many times faster than the theory layers of spheres that roll were simulated at a throw number:
/// validation/demo, tan(beta) = 0.5, friction 0.23; nothing outside throw number 1.2 to 2.3, where the theory
/// was not found to be wrong.
std::optional<double> known_factor(double throw_number);

/// m/s: the rule of Daesung Machinery for horizontal vibrating conveyors, v = 3.81 N S in m/min with N in
/// cycles per minute and S, the amplitude, in m; 70 to 80 % of it are used in practice
/// (dsv.co.kr/vibrating_machinery_vc_06.html, read in 2026).
double rule_of_thumb(double frequency, double amplitude);

}  // namespace vibrotrough::learn
