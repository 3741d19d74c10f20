#include "app/point_mass.hpp"

#include "compare/comparison.hpp"

namespace vibrotrough::app {

std::optional<theory::ConveyorMotion> point_mass_motion(Trough const& trough) {
    if (trough.waveform) return {};
    theory::Conveyor conveyor{};
    conveyor.point = compare::plastic_point_mass(trough);
    conveyor.along_phase = trough.along_phase;
    for (DriveHarmonic const& harmonic : trough.harmonics) {
        conveyor.along.push_back({harmonic.order, harmonic.ratio, harmonic.phase});
        conveyor.normal.push_back({harmonic.order, harmonic.ratio, harmonic.phase});
    }
    theory::ConveyorMotion motion = theory::solve(conveyor);
    if (motion.motion.outcome != theory::Outcome::periodic) return {};
    return motion;
}

}  // namespace vibrotrough::app
