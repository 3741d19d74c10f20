#include "theory/conveyor.hpp"

#include "theory/detail/ranges.hpp"
#include "theory/detail/solver.hpp"

#include <algorithm>

namespace vibrotrough::theory {

EffectiveFriction effective_friction(Conveyor const& c) {
    double const wall = c.wall_pressure_ratio * c.wall_friction * c.height_over_width;
    double const kinetic = c.point.friction;
    return {kinetic + wall, std::max(kinetic, c.static_friction) + wall,
            c.landing_friction.value_or(kinetic) + wall};
}

ConveyorMotion solve(Conveyor const& conveyor) {
    detail::check_ranges(conveyor);
    return detail::ConveyorSolver().motion(conveyor);
}

}  // namespace vibrotrough::theory
