#include "compare/point_mass_motion.hpp"

#include "theory/inputs.hpp"

#include <cmath>
#include <optional>

namespace vibrotrough::compare {
namespace {

theory::Inputs plain_inputs(scenario::Trough const& trough, double friction) {
    theory::Inputs inputs;
    // The machine number also describes a trough that shakes along itself.
    inputs.set(theory::Input::machine_number, machine_number(trough));
    inputs.set(theory::Input::tan_vibration_angle, std::tan(trough.vibration_angle));
    inputs.set(theory::Input::tan_inclination, std::tan(trough.inclination));
    inputs.set(theory::Input::friction, friction);
    return inputs;
}

bool is_plain(scenario::Scenario const& s) {
    return !s.trough.side_wall_friction && s.trough.along_phase == 0 && s.trough.harmonics.empty() &&
           !s.trough.waveform;
}

std::optional<scenario::DriveTerm> fundamental(std::vector<scenario::DriveTerm> const& terms) {
    for (scenario::DriveTerm const& term : terms) {
        if (term.order == 1) return term;
    }
    return {};
}

/// Terms beside the fundamental, as accelerations in units of `amplitude`, in a time that began `shift` rad
/// earlier.
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

/// The fundamental normal to the trough sets the throw number and the unit normal to the trough; the unit
/// along it stays r cos(beta), in which the efficiency is told.
void set_drive(theory::Conveyor& conveyor, scenario::Trough const& trough) {
    scenario::DriveMotion const motion = drive_motion(trough);
    double const along_unit = trough.amplitude * std::cos(trough.vibration_angle);
    auto const along = fundamental(motion.along), normal = fundamental(motion.normal);
    double const shift = normal ? normal->phase : along ? along->phase : 0;
    if (normal) {
        double const omega = angular_frequency(trough);
        conveyor.point.throw_number =
            omega * omega * normal->amplitude / (scenario::gravity * std::cos(trough.inclination));
        conveyor.point.tan_vibration_angle = normal->amplitude / along_unit;
        conveyor.normal = harmonics(motion.normal, normal->amplitude, shift);
    }
    conveyor.along_ratio = along ? along->amplitude / along_unit : 0;
    conveyor.along_phase = along ? along->phase - shift : 0;
    conveyor.along = harmonics(motion.along, along_unit, shift);
}

}  // namespace

theory::Conveyor conveyor_of(scenario::Scenario const& scenario, double friction) {
    scenario::Trough const& trough = scenario.trough;
    theory::Conveyor conveyor = plain_inputs(trough, friction).conveyor();
    set_drive(conveyor, trough);
    if (trough.side_wall_friction) {
        conveyor.wall_friction = *trough.side_wall_friction;
        conveyor.height_over_width = layer_height(scenario) / scenario.layer.width;
    }
    return conveyor;
}

theory::Motion point_mass_motion(scenario::Scenario const& scenario, double friction) {
    if (is_plain(scenario)) return theory::solve(plain_inputs(scenario.trough, friction).point());
    return theory::solve(conveyor_of(scenario, friction)).motion;
}

}  // namespace vibrotrough::compare
