#pragma once

#include "view/frames.hpp"

#include <filesystem>
#include <vector>

namespace vibrotrough::view {

/// The position of the trough in one frame, as written by the engine.
struct TroughPosition {
    long step;  ///< time step of the engine
    double x;   ///< m, displacement from rest
    double z;   ///< m, displacement from rest
};

/// The position and velocity of the trough according to the drive.
using scenario::TroughState;

/// @param time  s, since the start of the drive
TroughState trough_state(FrameSource const& source, double time);

/// Reads frames.csv, whose steps must increase. A last line without a line end is left out, because the
/// engine may still be writing it. @throws InputError naming file and line; MissingError if the file does not
/// exist
std::vector<TroughPosition> read_trough_motion(std::filesystem::path const& path);

}  // namespace vibrotrough::view
