#pragma once

#include "prepare/prepared_case.hpp"
#include "theory/conveyor.hpp"

#include <optional>
#include <string>

namespace vibrotrough::compare {

/// What the theory's pure numbers must be multiplied with to be in SI units.
struct PointMassScale {
    double length_x, length_z;  ///< m, amplitudes of the trough along x and normal to it
    double angular_frequency;   ///< rad/s
    double phase_at_start;      ///< rad, of the theory's time when the drive's phase is 0
};

/// The theory's periodic motion of a point mass in place of a case's layer.
struct PointMassMotion {
    theory::ConveyorMotion motion;  ///< in the theory's pure numbers
    PointMassScale scale;           ///< to SI units
};

/// Solves the motion of a point mass on a case's trough, with the friction of a grain on the trough.
/// None when the motion has no period.
std::optional<PointMassMotion> point_mass_motion(prepare::PreparedCase const& prepared);

/// One period of the point mass as CSV for the figures: a header and 360 lines per cycle, in SI units. Forces
/// are per mass (N/kg). Displacements are relative to the trough since the drive's phase 0.
std::string point_mass_csv(PointMassMotion const& point_mass);

}  // namespace vibrotrough::compare
