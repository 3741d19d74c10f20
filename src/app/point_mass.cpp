#include "app/point_mass.hpp"

#include <cmath>
#include <utility>

namespace vibrotrough::app {

std::optional<view::TheoryMotion> point_mass_beside(prepare::PreparedCase const& prepared) {
    scenario::Trough const& trough = prepared.scenario.trough;
    theory::Conveyor const& conveyor = prepared.point_mass.conveyor;
    theory::ConveyorMotion motion = theory::solve(conveyor);
    if (motion.motion.outcome != theory::Outcome::periodic) return {};
    double const length_x = trough.amplitude * std::cos(trough.vibration_angle);
    return view::TheoryMotion{.motion = std::move(motion),
                              .length_x = length_x,
                              .length_z = length_x * conveyor.point.tan_vibration_angle,
                              .phase_at_start = prepared.point_mass.start_phase};
}

}  // namespace vibrotrough::app
