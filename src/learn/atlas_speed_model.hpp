#pragma once

#include "learn/calibration.hpp"

#include <map>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// The quantities of a layer of spheres that can be free: friction, grain_friction, rolling_friction,
/// restitution, depth (in diameters), inclination and vibration_angle (both in degrees). The prior of each is
/// its range in the atlas.
std::vector<FreeParameter> const& atlas_parameters();

/// The names of `free`, followed by the properties of the layer that are neither free nor fixed. What is not
/// known of the grains and of the depth is the same in all measurements, so that it is found with the rest,
/// as far as the speeds tell.
std::vector<std::string> with_unknown_layer(std::vector<std::string> free,
                                            std::map<std::string, double> const& fixed);

/// The atlas of simulated layers (atlas/atlas.hpp) as a model of measured speeds. The gravity is 9.81 m/s^2.
/// Half of the variance of its error is taken as common to all measurements, and all of the numerical errors.
/// @param diameter  m, of the grains, > 0
/// @param free      names out of atlas_parameters(), which with `fixed` must name all properties of the layer
/// @param fixed     values of further such quantities, by name, in the same units. A free or fixed
/// inclination
///                  or vibration angle replaces that of the measurements. An inclination that is given
///                  nowhere is zero.
/// @throws core::InputError when a name is unknown or given twice, a vibration angle is missing, or a
/// measurement or a fixed value lies outside of the atlas
CalibrationModel atlas_speed_model(double diameter, std::vector<std::string> const& free,
                                   std::map<std::string, double> const& fixed,
                                   std::vector<MeasuredSpeed> const& speeds);

}  // namespace vibrotrough::learn
