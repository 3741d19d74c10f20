#pragma once

#include "atlas/surface.hpp"
#include "prepare/prepared_case.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::atlas {

/// Something of a case that the atlas does not cover.
struct Outside {
    std::string name;  ///< of an input of the atlas, or the key of the campaign file
    std::string why;   ///< such as "depth 14 (the atlas has 3 to 6)"
};

/// What the atlas says of a layer.
struct Answer {
    std::optional<double> efficiency;  ///< velocity efficiency; none for a layer of another kind, or without
                                       ///< a mean speed by the rolling-layer law
    std::optional<double> half_width;  ///< of its 95 % interval
    std::vector<Outside> outside;      ///< empty: the layer lies inside of the atlas

    /// Whether the atlas covers the layer.
    bool is_inside() const { return outside.empty(); }
};

/// How many layers were simulated for the atlas.
int simulated_layers();

/// The part of every half-width that stands for numerical errors of the simulated layers: the mean of their
/// bounds, in velocity efficiency.
double numerical_error();

/// The lengths over which the error of the rolling-layer law changes, as the layers of the atlas tell:
/// medians of the draws of its process, one for each of inputs() (tables.hpp) and in its unit.
Place error_lengths();

/// What the atlas says of a place: the numbers without a dimension of inputs() (tables.hpp), in their order.
/// Nothing when theory or law have no mean speed there. The half-width contains what the layers scatter
/// beyond their own intervals, and their numerical errors.
std::optional<SurfaceValue> value_at(Place const& place);

/// Predicts the velocity efficiency of a layer from those that were simulated for the atlas
/// (validation/atlas): a Surface over the numbers without a dimension on which the efficiency of a layer of
/// spheres depends, whose trend is the rolling-layer law (trend_of() in tables.hpp). The half-width contains
/// what the layers scatter beyond their own intervals, and their numerical errors.
///
/// A layer of another kind (clumps, several materials, side walls closer than 20 diameters, an open trough,
/// a drive that is not a sinusoid, ...) has no efficiency. A layer of the same kind with inputs outside of
/// the ranges has one, which is an extrapolation, up to a quarter of a range beyond it.
Answer predict(prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::atlas
