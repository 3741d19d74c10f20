#include "prepare/point_mass.hpp"

#include "scenario/model/materials.hpp"
#include "theory/errors.hpp"
#include "theory/inputs.hpp"

#include <cmath>
#include <optional>

namespace vibrotrough::prepare {
namespace {

theory::Inputs plain_inputs(scenario::Scenario const& scenario) {
    scenario::Trough const& trough = scenario.trough;
    theory::Inputs inputs;
    if (trough.given.throw_number) {
        inputs.set(theory::Input::throw_number, *trough.given.throw_number);
    } else {
        // Unlike the throw number, the machine number also describes a trough that vibrates along its own
        // surface.
        inputs.set(theory::Input::machine_number, machine_number(trough));
    }
    // A trough that vibrates normal to itself only has its whole amplitude as the unit along it.
    inputs.set(theory::Input::tan_vibration_angle,
               is_vertical(trough) ? 1 : std::tan(trough.vibration_angle));
    inputs.set(theory::Input::tan_inclination, std::tan(trough.inclination));
    inputs.set(theory::Input::friction, mean_trough_friction(scenario));
    return inputs;
}

bool is_plain_sinusoid(scenario::Trough const& trough) {
    return trough.along_phase == 0 && trough.harmonics.empty() && !trough.waveform && !is_vertical(trough);
}

std::optional<scenario::DriveTerm> fundamental(std::vector<scenario::DriveTerm> const& terms) {
    for (scenario::DriveTerm const& term : terms) {
        if (term.order == 1) return term;
    }
    return {};
}

/// The terms other than the fundamental as accelerations in units of `amplitude`, for a time whose zero is
/// shifted by `shift` rad.
std::vector<theory::Harmonic> harmonics(std::vector<scenario::DriveTerm> const& terms, double amplitude,
                                        double shift) {
    std::vector<theory::Harmonic> result;
    for (scenario::DriveTerm const& term : terms) {
        if (term.order == 1) continue;
        result.push_back({term.order, term.order * term.order * term.amplitude / amplitude,
                          term.phase - term.order * shift});
    }
    return result;
}

/// The fundamental normal to the trough determines the throw number and the unit of length normal to the
/// trough. The unit along the trough stays r cos(beta), because the efficiency is expressed in it.
void set_drive(PointMassInputs& inputs, scenario::Trough const& trough, scenario::DriveMotion const& motion) {
    theory::Conveyor& conveyor = inputs.conveyor;
    double const along_unit = length_scale(trough);
    auto const along = fundamental(motion.along), normal = fundamental(motion.normal);
    double const shift = normal ? normal->phase : along ? along->phase : 0;
    inputs.start_phase = shift;
    if (normal) {
        // A measured fundamental may differ by up to 1 % from the amplitude and angle of the campaign file.
        if (trough.waveform || is_vertical(trough)) {
            double const omega = angular_frequency(trough);
            conveyor.point.throw_number =
                omega * omega * normal->amplitude / (trough.gravity * std::cos(trough.inclination));
            conveyor.point.tan_vibration_angle = normal->amplitude / along_unit;
        }
        conveyor.normal = harmonics(motion.normal, normal->amplitude, shift);
    }
    conveyor.along_ratio = along ? along->amplitude / along_unit : 0;
    conveyor.along_phase = along ? along->phase - shift : 0;
    conveyor.along = harmonics(motion.along, along_unit, shift);
}

}  // namespace

PointMassInputs point_mass_inputs(scenario::Scenario const& scenario, scenario::DriveMotion const& motion,
                                  double layer_height) {
    scenario::Trough const& trough = scenario.trough;
    PointMassInputs inputs{plain_inputs(scenario).conveyor(), 0,
                           is_plain_sinusoid(trough) && !trough.side_wall_friction,
                           mean_trough_restitution(scenario)};
    set_drive(inputs, trough, motion);
    if (trough.side_wall_friction) {
        inputs.conveyor.wall_friction = *trough.side_wall_friction;
        inputs.conveyor.height_over_width = layer_height / scenario.layer.width;
    }
    return inputs;
}

PointMassInputs with_friction(PointMassInputs inputs, double friction) {
    inputs.conveyor.point.friction = friction;
    if (inputs.conveyor.wall_friction == 0) return inputs;
    inputs.conveyor.wall_friction = 0;
    inputs.conveyor.height_over_width = 0;
    inputs.is_plain = inputs.conveyor.along.empty() && inputs.conveyor.normal.empty() &&
                      inputs.conveyor.along_ratio == 1 && inputs.conveyor.along_phase == 0;
    return inputs;
}

theory::Motion solve(PointMassInputs const& inputs) {
    if (inputs.is_plain) return theory::solve(inputs.conveyor.point);
    return theory::solve(inputs.conveyor).motion;
}

std::optional<theory::Efficiency> solve_with_restitution(PointMassInputs const& inputs) {
    if (inputs.restitution > theory::largest_restitution) return {};
    theory::Conveyor conveyor = inputs.conveyor;
    conveyor.restitution = inputs.restitution;
    try {
        return theory::EfficiencySolver().solve(conveyor);
    } catch (theory::PhaseError const&) {  // the plastic motion, which the paper has, may still be known
        return {};
    }
}

PointMassTheory point_mass_theory(PointMassInputs const& inputs) {
    PointMassTheory known;
    theory::Motion const plastic = solve(inputs);
    known.mode = plastic.mode;
    if (plastic.converged) known.efficiency = plastic.velocity_efficiency;
    auto const rebounding = solve_with_restitution(inputs);
    if (!rebounding) return known;
    known.mode_restitution = theory::to_string(rebounding->mode);
    bool const is_mean = rebounding->outcome == theory::Outcome::unsettled;
    if (rebounding->outcome == theory::Outcome::periodic || is_mean)
        known.efficiency_restitution = rebounding->velocity_efficiency;
    if (is_mean) known.half_width_restitution = rebounding->half_width;
    return known;
}

}  // namespace vibrotrough::prepare
