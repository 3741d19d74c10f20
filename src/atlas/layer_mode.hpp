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
/// (value.hpp). Of the 76 random layers within the ranges, which are none of them, 57 moved in the mode that
/// is said (tests/atlas).
LikelyMode mode_at(Place const& place);

/// How many simulated layers decide about the period: those of the nearest throw numbers, since only those
/// thrown far may repeat after several cycles. (Layers that are most alike foretell it less well.)
inline constexpr int layers_asked_for_period = 25;

/// How many of the layers_asked_for_period simulated layers whose period is known, and whose throw numbers
/// are nearest, repeat only after several cycles. Of 76 random layers 11 do: 8 of the 26 where a fifth of the
/// layers asked or more do, and 3 of the other 50 (tests/atlas).
int repeating_later(double throw_number);

}  // namespace vibrotrough::atlas
