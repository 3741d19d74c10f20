#pragma once

#include "scenario/scenario.hpp"
#include "theory/conveyor.hpp"

#include <optional>

namespace vibrotrough::app {

/// The plastic point mass's periodic motion on this trough and its drive, with its pieces; lengths are in r
/// cos(beta) and r sin(beta). None when it has no period, and none for a measured waveform.
std::optional<theory::ConveyorMotion> point_mass_motion(Trough const& trough);

}  // namespace vibrotrough::app
