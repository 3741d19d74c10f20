#pragma once

#include "atlas/surface.hpp"

#include <optional>

namespace vibrotrough::atlas {

/// A number of which a 95 % interval is known.
struct Bounded {
    double value;       ///< best estimate
    double half_width;  ///< of the interval
};

/// What a layer does to the trough that carries it, by the first harmonic of its force. Like the efficiency,
/// both depend on the numbers without a dimension of a Place alone.
struct LayerLoad {
    /// The part of the layer's mass that moves with the trough: 1 for a layer that is fixed to it.
    Bounded added_mass;
    /// The damping that the layer adds, over its mass times omega.
    Bounded damping;
};

/// What the layers of the atlas did to their trough (validation/atlas), by surfaces without a trend over
/// those of them that have these numbers. The half-widths contain what the layers scatter.
LayerLoad load_at(Place const& place);

/// W/kg, the mean power that a trough gives to its layer over the mass of the layer; none where the surface
/// of the damping is not above zero, as it can be outside of what was simulated: no layer drives its trough.
/// It is the damping times the mean
/// square of the trough's velocity. It is exact for a sinusoidal drive, because only the first harmonic of
/// the force works. @param amplitude  m @param frequency  Hz
std::optional<Bounded> power_per_mass(LayerLoad const& load, double amplitude, double frequency);

}  // namespace vibrotrough::atlas
