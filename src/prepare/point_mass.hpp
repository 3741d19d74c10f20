#pragma once

#include "scenario/model/scenario.hpp"
#include "theory/conveyor.hpp"

namespace vibrotrough::prepare {

/// The point mass by which the theory represents the layer of a case.
struct PointMassInputs {
    /// Plastic impact, the case's drive with its harmonics, ellipse or measured waveform, and its side walls
    /// by Janssen's stress ratio over the layer's height. Its time is zero where the fundamental of the
    /// normal motion passes its mean upwards.
    theory::Conveyor conveyor;
    double start_phase;  ///< rad, time of the conveyor at step 0 of a run
    bool is_plain;  ///< whether a sinusoid without side walls allows the fast solver of theory/point_mass.hpp
};

/// The point mass of a case.
/// @param motion        of the trough, from scenario::drive_motion
/// @param layer_height  m, of the layer at rest
PointMassInputs point_mass_inputs(scenario::Scenario const& scenario, scenario::DriveMotion const& motion,
                                  double layer_height);

/// The same point mass with another friction and without side walls, for a layer whose friction was measured
/// in its trough. The effect of the walls is already included in the measured friction.
/// @param friction  static and kinetic coefficient
PointMassInputs with_friction(PointMassInputs inputs, double friction);

/// The periodic motion. A plain sinusoid takes microseconds, any other drive up to a millisecond.
theory::Motion solve(PointMassInputs const& inputs);

}  // namespace vibrotrough::prepare
