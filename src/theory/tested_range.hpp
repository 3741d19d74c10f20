#pragma once

#include "theory/drive.hpp"
#include "theory/point_mass.hpp"

#include <optional>
#include <string>

namespace vibrotrough::theory {

/// A series of layers of validation/rolling_layer to which the rolling-layer law was not fitted.
struct TestedLayers {
    Range throw_number;  ///< from the lowest to the highest of them
    double slope;        ///< |tan(alpha)|
    double depth;        ///< of the layer, in diameters of its grains
};

/// On the level, layers of four diameters. A test compares these series with validation/rolling_layer.
inline constexpr TestedLayers tested_level{{1.25, 2.6}, 0, 4};
inline constexpr TestedLayers tested_slopes{{1.6, 2.3}, 0.08, 4};  ///< downhill and uphill
inline constexpr TestedLayers tested_shallow{{1.6, 1.9}, 0, 3};    ///< the shallowest
inline constexpr TestedLayers tested_deep{{1.6, 1.9}, 0, 16};      ///< the deepest
inline constexpr Range tested_tan_vibration_angle{0.35, 0.75};     ///< of all of them
inline constexpr Range tested_friction{0.15, 0.6};                 ///< of all of them, mu

/// The throw numbers at which the law has been tested on a slope and, if it is known, at a depth: between the
/// series of layers, in proportion to slope and depth (their convex hull). Nothing beyond the steepest,
/// shallowest and deepest.
/// @param depth  of the layer, in diameters of its grains
std::optional<Range> tested_throw_numbers(double tan_inclination, std::optional<double> depth = {});

/// A sentence that says why the rolling-layer law has not been tested at this point; nothing within its
/// range. @param depth  of the layer, in diameters of its grains, if it is known
std::optional<std::string> outside_tested_range(PointMass const& point, std::optional<double> depth = {});

/// The drives of a space at which the law may have been tested: the box around its range.
/// @throws std::invalid_argument when there are none
DriveSpace within_tested_range(DriveSpace space);

/// How far the throw number of such a drive is outside what has been tested at its slope, relatively; zero or
/// less within.
double tested_excess(Drive const& drive, double gravity = 9.81);

}  // namespace vibrotrough::theory
