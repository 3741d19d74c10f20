#pragma once

#include "learn/speed_model.hpp"
#include "learn/uncertain.hpp"

#include <optional>

namespace vibrotrough::learn {

/// The grains of a layer of spheres as far as they are known.
struct KnownGrains {
    std::optional<double> diameter = {};             ///< m, > 0
    std::optional<Uncertain> rolling_friction = {};  ///< coefficient
    std::optional<Uncertain> friction = {};          ///< of grain on grain
};

/// The atlas of simulated layers as a model by which a machine can be designed. What is not known of the
/// grains is in the middle of the atlas. What each may change at the layer, while the others stay, is part of
/// the model's uncertainty: its sources, which add up in squares. Beyond the atlas untested() says so.
/// @param grains       with their diameter
/// @param discrepancy  standard deviation of what the atlas misses of a real layer, in velocity efficiency
/// @param friction     of the material on the trough, at which that is looked at; 0: the middle of the atlas
/// @throws core::InputError when the friction of the grains lies outside of the atlas
DesignModel atlas_design_model(KnownGrains const& grains, double discrepancy = 0, double friction = 0);

}  // namespace vibrotrough::learn
