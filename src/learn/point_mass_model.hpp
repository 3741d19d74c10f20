#pragma once

#include "learn/calibration.hpp"

#include <map>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// The quantities of the point mass that can be free: friction, static_friction, landing_friction,
/// restitution, inclination (degree) and vibration_angle (degree), each with the prior that it has unless the
/// user gives another.
std::vector<FreeParameter> const& point_mass_parameters();

/// The exact point-mass theory as a model of measured speeds. The gravity is 9.81 m/s^2.
/// @param free   names out of point_mass_parameters(); their values are those of the model, in this order
/// @param fixed  values of further such quantities, by name, in the same units. A free or fixed inclination
/// or vibration angle replaces that of the measurements. An inclination that is given nowhere is zero.
/// @throws core::InputError when a name is unknown or given twice, or friction or a vibration angle is
/// missing
CalibrationModel point_mass_model(std::vector<std::string> const& free,
                                  std::map<std::string, double> const& fixed,
                                  std::vector<MeasuredSpeed> const& speeds);

}  // namespace vibrotrough::learn
