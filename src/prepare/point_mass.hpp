#pragma once

#include "scenario/model/scenario.hpp"
#include "theory/conveyor.hpp"

namespace vibrotrough::prepare {

/// The point mass that the theory puts in place of a case's layer.
struct PointMassInputs {
    /// Plastic impact, the case's drive with its harmonics, ellipse or measured waveform, and its side walls
    /// by Janssen's stress ratio over the layer's height. Its time is zero where the fundamental of the
    /// normal motion passes its mean upwards.
    theory::Conveyor conveyor;
    double start_phase;  ///< rad: phase of the drive's fundamental at step 0 of a run, in the conveyor's time
    bool is_plain;       ///< a sinusoid without side walls: the fast solver of theory/point_mass.hpp applies
};

/// @param motion        of the trough, as scenario::drive_motion gives it
/// @param layer_height  m, of the layer at rest
PointMassInputs point_mass_inputs(scenario::Scenario const& scenario, scenario::DriveMotion const& motion,
                                  double layer_height);

/// The same point mass with another friction and without side walls: for a layer whose friction was measured
/// in its trough, so that the effect of the walls is already included.
PointMassInputs with_friction(PointMassInputs inputs, double friction);

/// The periodic motion. A plain sinusoid is solved in microseconds, anything else in up to a millisecond.
theory::Motion solve(PointMassInputs const& inputs);

}  // namespace vibrotrough::prepare
