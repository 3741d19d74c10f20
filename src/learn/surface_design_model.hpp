#pragma once

#include "learn/atlas_design_model.hpp"
#include "learn/campaign_surface.hpp"
#include "learn/speed_model.hpp"

#include <map>
#include <memory>
#include <string>

namespace vibrotrough::learn {

/// What is known of the material of a design.
struct KnownMaterial {
    KnownFriction friction;   ///< on the trough
    KnownGrains grains = {};  ///< of it
};

/// The surface of a simulated layer as a model by which a machine can be designed, with its own uncertainty.
/// The drive chooses the place on the surface, within the range that was simulated; what the campaign does
/// not vary of the machine stays as it is there.
/// @param trend     of the campaign, with the values of keys that are words
/// @param given     values of inputs that describe neither the machine nor trough.friction, by key, SI units
/// @param material  must be the one that was simulated: grains and friction as far as they are given. A
/// design
///   has the depth of the simulated layer
/// @param numerics  CampaignPoints::numerics of the surface's cases
/// @param discrepancy  standard deviation of what the surface misses of a real layer, in velocity efficiency
/// @throws core::InputError when an input has no value, or the campaign cannot describe the material
DesignModel surface_design_model(std::shared_ptr<atlas::Surface const> surface, CampaignTrend const& trend,
                                 std::map<std::string, double> const& given, KnownMaterial const& material,
                                 double numerics, double discrepancy = 0);

}  // namespace vibrotrough::learn
