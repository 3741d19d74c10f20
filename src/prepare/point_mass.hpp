#pragma once

#include "scenario/model/scenario.hpp"
#include "theory/conveyor.hpp"
#include "theory/efficiency.hpp"

#include <optional>
#include <string>

namespace vibrotrough::prepare {

/// The point mass by which the theory represents the layer of a case.
struct PointMassInputs {
    /// Plastic impact as in the paper, the case's drive with its harmonics, ellipse or measured waveform, and
    /// its side walls by Janssen's stress ratio over the layer's height. Its time is zero where the
    /// fundamental of the normal motion passes its mean upwards.
    theory::Conveyor conveyor;
    double start_phase;  ///< rad, time of the conveyor at step 0 of a run
    bool is_plain;  ///< whether a sinusoid without side walls allows the fast solver of theory/point_mass.hpp
    double restitution = 0;  ///< e of a grain on the trough, which the plastic conveyor leaves out
};

/// What the theory says of the point mass of a case.
struct PointMassTheory {
    std::optional<double> efficiency;  ///< plastic impact, as in the paper; none without a mean speed
    std::string mode;                  ///< of that motion; empty when it has none
    /// With the case's restitution; none without a mean speed and where the theory cannot answer.
    std::optional<double> efficiency_restitution;
    /// Half-width of the 95 % interval of efficiency_restitution; none when the motion has a period and the
    /// efficiency is therefore exact.
    std::optional<double> half_width_restitution;
    std::string mode_restitution;  ///< of that motion; empty when it has none
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

/// The motion with the case's restitution. With rebounds a motion often has no period, and its efficiency is
/// a mean with an interval; it takes about a millisecond. None where the theory cannot answer: its
/// restitution ends at theory::largest_restitution.
std::optional<theory::Efficiency> solve_with_restitution(PointMassInputs const& inputs);

/// Both.
PointMassTheory point_mass_theory(PointMassInputs const& inputs);

}  // namespace vibrotrough::prepare
