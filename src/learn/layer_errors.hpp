#pragma once

#include "learn/calibration.hpp"

#include <map>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// What the plastic point mass misses at layers of spheres, in all measurements together: its velocity
/// efficiency is compared with that of the atlas (atlas/value.hpp) at each measurement for a few hundred
/// layers, each of which has the same friction, grains and depth in all measurements. Neighbouring
/// measurements have similar errors, distant ones mostly others, and no friction explains them all.
///
/// The errors count with their mean, so that grains which miss the point mass by less are covered, too.
/// Up to a quarter of a range outside of the atlas, the nearest place within it stands for a measurement;
/// farther outside nothing is known, and no error counts.
/// @param free      a free friction or angle may be anything within its prior and the atlas
/// @param fixed     values of friction and angles, as for point_mass_model()
/// @param speeds    each with its vibration angle, unless that is free or fixed
/// @returns common errors as CalibrationSettings::layer_errors
Eigen::MatrixXd point_mass_layer_errors(std::vector<FreeParameter> const& free,
                                        std::map<std::string, double> const& fixed,
                                        std::vector<MeasuredSpeed> const& speeds);

}  // namespace vibrotrough::learn
