#pragma once

#include <optional>

/// @file
/// What is fed into an open trough, which has a back wall, side walls and an edge where grains leave it.

namespace vibrotrough::scenario {

struct Scenario;

/// The stream of grains that falls into the trough at its back wall. A trough without one is periodic.
struct Feed {
    std::optional<double> mass_flow = {};  ///< kg/s
    std::optional<double> length = {};     ///< m, along the trough, of the zone that the stream falls into
    std::optional<double> width = {};      ///< m, of the stream, in the middle of the trough
    /// m, from which the grains fall, above the lowest point of the trough.
    std::optional<double> height = {};
    /// 1/s, where the flow was given so; mass_flow follows from it.
    std::optional<double> grains_per_second = {};
};

/// Whether the trough is open: fed at one end and discharged at the other.
bool is_open(Scenario const& scenario);

/// The layer that a feed will probably make, for what must be known before a run: stiffness, box and cost. It
/// assumes a velocity efficiency of 0.9 (Gamma - 0.9), at least 0.1 and at most 0.95, which is within a
/// factor of two of the layers of validation/demo and tests/measure/reference.
double expected_speed(Scenario const& scenario);  ///< m/s

/// Length of the zone that the stream falls into, m: as given, or a tenth of the trough and at least four of
/// the largest diameters.
double feed_length(Scenario const& scenario);

/// Width of the stream, m: as given, or that of the trough.
double feed_width(Scenario const& scenario);

/// The highest point of the trough that the stream may fall on, m above its lowest point; 0 of a flat floor.
double floor_under_feed(Scenario const& scenario);

/// The surface of the expected layer under the stream, at rest, m above the lowest point of the trough.
double layer_under_feed(Scenario const& scenario);

/// Height from which the grains fall, m above the lowest point of the trough: as given, or above the highest
/// point under the stream twice the expected height of the layer and six of the largest diameters.
double feed_height(Scenario const& scenario);

/// Speed at which the stream enters the trough, m/s, so that its grains fill 0.15 of its volume. Loose enough
/// for random insertion, which finds hardly any room above 0.3.
double feed_speed(Scenario const& scenario);

}  // namespace vibrotrough::scenario
