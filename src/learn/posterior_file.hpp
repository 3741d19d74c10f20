#pragma once

#include "learn/speed_model.hpp"

#include <string>
#include <string_view>

namespace vibrotrough::learn {

/// What a calibration says of the friction.
struct PosteriorFriction {
    KnownFriction friction;  ///< of the material on the trough
    std::string model;       ///< that was calibrated: "the point mass", "the simulated layer"
};

/// Reads the friction from what a calibration wrote (`--posterior FILE`: the draws, with the model
/// discrepancy beside each) or printed (`--json`: median and interval, taken as those of a normal
/// distribution).
/// @param text  JSON; @param file  its name, for errors
/// @throws core::InputError when it is no calibration, or has no friction
PosteriorFriction read_posterior(std::string_view text, std::string const& file);

}  // namespace vibrotrough::learn
