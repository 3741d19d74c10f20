#pragma once

#include "atlas/layer_load.hpp"
#include "atlas/value.hpp"
#include "prepare/prepared_case.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::atlas {

/// What the atlas says of a layer.
struct Answer {
    std::optional<double> efficiency;  ///< velocity efficiency; none for a layer of another kind, or without
                                       ///< a mean speed by the rolling-layer law
    std::optional<double> half_width;  ///< of its 95 % interval
    std::optional<Place> place;        ///< its numbers without a dimension, where it has an efficiency
    std::vector<Outside> outside;      ///< empty: the layer lies inside of the atlas
    /// m, of an open trough, where it has an efficiency: its layer between feed and edge, if it had settled.
    std::optional<Bounded> fed_depth = {};

    /// Whether the atlas covers the layer.
    bool is_inside() const { return outside.empty(); }
};

/// Predicts the velocity efficiency of a layer from those that were simulated for the atlas
/// (validation/atlas): a Surface over the numbers without a dimension on which the efficiency of a layer of
/// spheres depends, whose trend is the rolling-layer law (trend_of() in tables.hpp). The half-width contains
/// what the layers scatter beyond their own intervals, and their numerical errors.
///
/// The layer of an open trough is as deep as its feed makes it: h = Q / (rho_b b v), where the speed v is
/// that of a layer of the depth h, and rho_b the bulk density. Half-widths count that a slower layer is
/// deeper, and has the speed of its new depth.
///
/// A layer of another kind (clumps, several materials, side walls closer than 20 diameters, which may be
/// smooth in an open trough, a drive that is not a sinusoid, ...) has no efficiency. A layer of the same kind
/// with inputs outside of the ranges has one, which is an extrapolation, up to a quarter of a range beyond
/// it.
Answer predict(prepare::PreparedCase const& prepared);

/// The numbers without a dimension of a layer, in the order of inputs(), whether they lie within the ranges
/// or not; nothing for a layer of another kind or of an open trough, whose depth is not given.
std::optional<Place> place_of(prepare::PreparedCase const& prepared);

/// What single inputs change, by the atlas.
struct Effects {
    double depth;  ///< of the layer, in diameters
    /// The efficiency at its depth minus that at the least depth of the atlas; none without a difference in
    /// depth.
    std::optional<SurfaceValue> of_depth;
    /// The difference from the point mass at its slope minus that on the level, at the same throw number;
    /// none on the level.
    std::optional<SurfaceValue> of_slope;
};

/// What depth and slope of a layer change; nothing for a layer outside of the atlas or of an open trough.
std::optional<Effects> effects(prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::atlas
