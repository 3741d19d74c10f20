#pragma once

#include "atlas/surface.hpp"

#include <string>

namespace vibrotrough::atlas {

/// How many of the simulated layers that are most alike decide about a mode.
inline constexpr int layers_asked = 5;

/// How a layer probably moves.
struct LikelyMode {
    std::string mode;  ///< phases in the order of a cycle, as layer_mode of a campaign's results
    int agreeing;      ///< of the layers_asked simulated layers that are most alike, those in this mode
};

/// The most frequent mode among the simulated layers that are most alike: by the distance in error_lengths()
/// (value.hpp). Of the 116 random layers within the ranges, which are none of them, 87 moved in the mode that
/// is said (tests/atlas).
LikelyMode mode_at(Place const& place);

/// How many of them decide about the period, since few layers repeat only after several cycles.
inline constexpr int layers_asked_for_period = 9;

/// How many of the layers_asked_for_period simulated layers that are most alike, and whose period is known,
/// repeat only after several cycles. Of 76 random layers 11 do: 6 of the 24 of which two or more of those most
/// alike do, and 5 of the other 52 (tests/atlas).
int repeating_later(Place const& place);

}  // namespace vibrotrough::atlas
