#pragma once

#include "atlas/tables.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// The atlas for a layer that is given as numbers without a dimension. It needs no campaign file, so that a
/// page in a browser has it as well.

namespace vibrotrough::atlas {

/// Something of a case that the atlas does not cover.
struct Outside {
    std::string name;  ///< of an input of the atlas, or the key of the campaign file
    std::string why;   ///< such as "depth 30 (the atlas has 3 to 20)"
};

/// Further beyond a range than this, in widths of it (for the depth: of its logarithm), the atlas says
/// nothing at all.
inline constexpr double farthest = 0.25;

/// How many layers were simulated for the atlas.
int simulated_layers();

/// The part of the half-width at a depth (in diameters) that stands for numerical errors which the simulated
/// layers have in common, in velocity efficiency: common_numerical_error, or from 8 diameters on the mean of
/// the bounds of deeper layers; from 6 diameters on it goes from one to the other, so that it does not jump.
double numerical_error(double depth);

/// The lengths over which the error of the rolling-layer law changes, as the layers of the atlas tell:
/// medians of the draws of a process that knows the law as its trend alone, one for each of inputs()
/// (tables.hpp), in widths of its range.
std::vector<double> error_lengths();

/// How far two places are apart, in the lengths over which the error of the law changes.
double distance_between(Place const& one, Place const& other);

/// What the atlas says of a place: the numbers without a dimension of inputs() (tables.hpp), in their order.
/// Nothing when theory or law have no mean speed there. The half-width contains what the layers scatter
/// beyond their own intervals, and their numerical errors.
std::optional<SurfaceValue> value_at(Place const& place);

/// The same of a layer of which not everything is known: what is not known is in the middle of its range, and
/// the half-width contains what it changes there when it lies anywhere in its range, each input alone.
std::optional<SurfaceValue> value_of(KnownNumbers const& numbers);

/// value_at() in a twentieth of the time, nearly: by one draw of the hyperparameters. For searches.
std::optional<SurfaceValue> near_value_at(Place const& place);

/// The efficiency alone of value_at(), which takes a fraction of the time.
std::optional<double> efficiency_at(Place const& place);

/// The efficiency alone of near_value_at().
std::optional<double> near_efficiency_at(Place const& place);

/// What the atlas says of the efficiency at one place minus that at another. The half-width is that of the
/// surface alone: numerical errors are common to both places, and a trend does not scatter as layers do.
std::optional<SurfaceValue> difference_between(Place const& place, Place const& other);

/// What of a place the atlas does not cover: numbers outside of its ranges or, where all lie inside, those
/// that no layer of it has together.
std::vector<Outside> outside_ranges(Place const& place);

/// The second of these alone: numbers that no layer of the atlas has together, with the range at the others.
std::vector<Outside> outside_together(Place const& place);

/// Whether a place lies so far outside of a range, more than a quarter of it, that the atlas says nothing.
bool is_far_outside(Place const& place);

/// The nearest place within the ranges of the atlas.
Place within_ranges(Place place);

/// Why side walls slow a layer down more than those of the atlas have it, which have none: "side walls 6
/// diameters apart (at least 20)"; nothing where they are far enough apart. @param width  in diameters
std::optional<std::string> why_too_narrow(double width);

/// What is said of a number outside of its range: "depth 30 (the atlas has 3 to 20)".
std::string range_text(std::string_view name, double value, double low, double high);

}  // namespace vibrotrough::atlas
