#pragma once

#include "view/frames.hpp"

#include <filesystem>
#include <vector>

namespace vibrotrough::view {

/// Where the trough is at one frame.
struct TroughPosition {
    long step;  ///< time step of the engine
    double x;   ///< m, displacement from rest
    double z;   ///< m, displacement from rest
};

/// Where the trough is meant to be, and how fast.
struct TroughState {
    double x, z;    ///< m, displacement from t = 0
    double vx, vz;  ///< m/s
};

/// @param time  s, since the drive's start
TroughState trough_state(FrameSource const& source, double time);

/// Reads frames.csv, steps rising. A last line without its end is left out: the engine may be writing it.
/// @throws InputError naming file and line; MissingError when there is no such file
std::vector<TroughPosition> read_trough_motion(std::filesystem::path const& path);

}  // namespace vibrotrough::view
