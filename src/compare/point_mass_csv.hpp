#pragma once

#include "theory/conveyor.hpp"

#include <string>

namespace vibrotrough::compare {

/// What the theory's pure numbers must be multiplied with.
struct PointMassScale {
    double length_x, length_z;  ///< m, amplitudes of the trough along x and normal to it
    double angular_frequency;   ///< rad/s
    double phase_at_start;      ///< rad, of the theory's time when the drive's phase is 0
};

/// One period of the point mass beside a case's layer as CSV, 360 lines per cycle, SI; forces are per mass.
std::string point_mass_csv(theory::ConveyorMotion const& motion, PointMassScale const& scale);

}  // namespace vibrotrough::compare
