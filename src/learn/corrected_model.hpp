#pragma once

#include "learn/speed_model.hpp"

#include <vector>

namespace vibrotrough::learn {

/// Of the variance of a model's error, the share that is common to all machines and measurements.
inline constexpr double common_share = 0.5;

/// A layer that was simulated on a machine.
struct SimulatedLayer {
    theory::Drive drive;           ///< of the machine
    double friction;               ///< of the material on the trough
    double depth;                  ///< m
    double efficiency;             ///< velocity efficiency
    double statistics_half_width;  ///< of its 95 % interval, without numerical errors
    double numerical_error;        ///< their bound, at 95 %
};

/// A model of the conveying speed, corrected by layers that were simulated on machines like the one that is
/// looked for.
///
/// What the model misses is taken for a Gaussian process over throw number, tan(beta), tan(alpha), friction
/// and amplitude in diameters. Its standard deviation is what the model says that it misses together with its
/// own uncertainty; its lengths are those over which the error of the rolling-layer law changes
/// (atlas::error_lengths()). Half of its variance is common to all machines, because a model that is too
/// slow for a layer here is mostly so there, too. Conditioned on the layers it is small where they were
/// simulated, and the model's own elsewhere.
///
/// What the model misses does not depend on the depth of the layer: at one drive it is averaged over depths.
///
/// The error counts as known where the layers have halved its standard deviation; elsewhere as the model
/// says.
/// @param layers    at least one
/// @param diameter  m, of the grains
/// @param confidence  up to which what the model misses is to be held, as DesignModel::missed()
DesignModel corrected_design_model(DesignModel const& model, std::vector<SimulatedLayer> const& layers,
                                   double diameter, double confidence = usual_confidence);

}  // namespace vibrotrough::learn
