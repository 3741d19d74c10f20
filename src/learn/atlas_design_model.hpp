#pragma once

#include "learn/design_model.hpp"

#include <optional>

namespace vibrotrough::learn {

/// The grains of a layer of spheres as far as they are known.
struct KnownGrains {
    double diameter;                              ///< m, > 0
    std::optional<double> rolling_friction = {};  ///< coefficient; nothing: anything between 0 and 0.2
};

/// The atlas of simulated layers as a model by which a machine can be designed. What is not known of the
/// grains, and the depth of the layer, is in the middle of the atlas, and what it may change is part of the
/// model's uncertainty: the root mean square over drives of the whole atlas.
/// @param discrepancy  standard deviation of what the atlas misses of a real layer, in velocity efficiency
/// @throws std::invalid_argument when the rolling friction lies outside of the atlas
DesignModel atlas_design_model(KnownGrains const& grains, double discrepancy = 0);

}  // namespace vibrotrough::learn
