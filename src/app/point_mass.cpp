#include "app/point_mass.hpp"

#include "compare/point_mass_motion.hpp"

#include <cmath>
#include <utility>

namespace vibrotrough::app {
namespace {

std::optional<scenario::DriveTerm> fundamental(std::vector<scenario::DriveTerm> const& terms) {
    for (scenario::DriveTerm const& term : terms) {
        if (term.order == 1) return term;
    }
    return {};
}

}  // namespace

std::optional<view::TheoryMotion> point_mass_beside(scenario::Scenario const& scenario) {
    scenario::Trough const& trough = scenario.trough;
    theory::Conveyor const conveyor = compare::conveyor_of(scenario, trough.friction);
    theory::ConveyorMotion motion = theory::solve(conveyor);
    if (motion.motion.outcome != theory::Outcome::periodic) return {};
    // Its time starts, as compare::conveyor_of has it, where the normal motion's fundamental passes its mean
    // upwards.
    scenario::DriveMotion const drive = drive_motion(trough);
    auto const along = fundamental(drive.along), normal = fundamental(drive.normal);
    double const length_x = trough.amplitude * std::cos(trough.vibration_angle);
    return view::TheoryMotion{.motion = std::move(motion),
                              .length_x = length_x,
                              .length_z = length_x * conveyor.point.tan_vibration_angle,
                              .phase_at_start = normal  ? normal->phase
                                                : along ? along->phase
                                                        : 0.0};
}

}  // namespace vibrotrough::app
