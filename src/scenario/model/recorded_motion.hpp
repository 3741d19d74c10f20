#pragma once

#include "scenario/model/drive.hpp"

#include <array>
#include <vector>

namespace vibrotrough::scenario {

/// The samples of a waveform's file, in m or m/s2, along and normal to the trough.
struct RecordedMotion {
    bool is_acceleration = false;                      ///< otherwise positions
    std::vector<double> time = {};                     ///< s
    std::array<std::vector<double>, 2> samples = {};   ///< as they were read
    std::array<std::vector<double>, 2> left_out = {};  ///< mean and drift, of the whole cycles that were used
};

/// Reads the file of a waveform again.
RecordedMotion recorded_motion(Waveform const& waveform);

}  // namespace vibrotrough::scenario
