#include "theory/detail/common/weak_forces.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory::detail {
namespace {

/// The factor that makes `force` noticeable; 1 when it is, or when there is none.
double needed_factor(double force, double weakest) {
    return force > 0 && force < weakest ? weakest / force : 1;
}

}  // namespace

PointMass with_noticeable_forces(PointMass const& input) {
    PointMass p = input;
    // A component of gravity that is larger than friction makes the mass run away: nothing is to be solved.
    if (std::abs(p.tan_inclination) > p.friction) return p;
    // In two steps, because 1 / 1e-320 is infinite.
    double const ratio = p.friction > 0 ? p.tan_inclination / p.friction : 0;
    double const weakest = weakest_force * std::min(1.0, p.throw_number) / p.tan_vibration_angle;
    if (p.friction > 0 && p.friction < weakest && weakest < 1e-6) {
        p.friction = weakest;
        p.tan_inclination = ratio * weakest;
    }
    return p;
}

Conveyor with_noticeable_forces(Conveyor const& input) {
    Conveyor c = input;
    EffectiveFriction const friction = effective_friction(c);
    double const strongest =
        std::max({friction.kinetic_friction, friction.static_friction, friction.landing_friction});
    // Of the largest force along the trough: mu N / (m omega^2 r cos(beta)) is mu tan(beta) / Gamma while N =
    // m g cos(alpha), and about mu tan(beta) in the impacts of a motion with flights.
    double const unit = c.point.tan_vibration_angle / std::min(1.0, c.point.throw_number);
    double const by_friction = strongest * unit;
    if (c.air_drag < 1e-18 * by_friction) c.air_drag = 0;
    if (std::abs(c.point.tan_inclination) > strongest && c.air_drag == 0) return c;
    double const by_gravity = std::abs(c.point.tan_inclination) * unit;
    double const factor = needed_factor(std::max({by_friction, c.air_drag, by_gravity}), weakest_force);
    if (factor == 1) return c;
    // The inverse of the smallest numbers is infinite: they take two steps.
    double const step = std::min(factor, 1e200);
    for (double* const force :
         {&c.point.friction, &c.static_friction, &c.point.tan_inclination, &c.air_drag, &c.wall_friction})
        *force *= step;
    if (c.landing_friction) *c.landing_friction *= step;
    return step == factor ? c : with_noticeable_forces(c);
}

}  // namespace vibrotrough::theory::detail
