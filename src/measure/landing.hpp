#pragma once

#include "measure/layer_motion.hpp"

#include <optional>

namespace vibrotrough::measure {

/// Tangential over normal impulse of the layer on the trough while it lands: from the end of its longest
/// flight until its centre of mass no longer falls against the trough. Positive where the landing brakes the
/// layer, at most mu; below mu where grains roll as well as where slip stops or turns before the
/// landing is over.
/// @return no value without a flight
std::optional<double> landing_friction(LayerMotion const& motion);

/// What efficiency_by_normal_force must be told of the trough.
struct SlidingMass {
    double mass;            ///< kg, of the layer
    double friction;        ///< mu
    double gravity_x;       ///< m/s^2, along the trough
    double frequency;       ///< Hz
    double velocity_scale;  ///< m/s, omega r cos(beta)
};

/// Velocity efficiency of a point mass with Coulomb friction, in place of the layer under the layer's own
/// normal force: m v' = -mu N(t) sign(v - V) + m g_x, in its periodic motion. What it differs by from the
/// theory is due to when and how hard the layer presses; what the layer differs by from it, to how its grains
/// pass the friction on (rolling, shear).
/// @param curves  floor_force, trough_velocity_x; the floor's force alone, so it means nothing with side
/// walls
/// @return no value when the mass runs away or the motion does not settle
std::optional<double> efficiency_by_normal_force(PhaseCurves const& curves, SlidingMass const& facts);

}  // namespace vibrotrough::measure
