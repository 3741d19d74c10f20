#pragma once

#include "scenario/model/scenario.hpp"
#include "theory/conveyor.hpp"

namespace vibrotrough::compare {

/// The point mass in place of a case's layer, as the theory's inputs: plastic impact, the case's drive with
/// its harmonics, ellipse or waveform, and side walls by Janssen's stress ratio over the layer's height. Time
/// begins where the normal motion's fundamental passes its mean upwards.
/// @param friction  of the layer on the trough
theory::Conveyor conveyor_of(scenario::Scenario const& scenario, double friction);

/// Its motion. A plain sinusoid without walls is solved in microseconds, all else in up to a millisecond.
theory::Motion point_mass_motion(scenario::Scenario const& scenario, double friction);

}  // namespace vibrotrough::compare
