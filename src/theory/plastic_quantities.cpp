#include "theory/plastic_quantities.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <boost/math/quadrature/gauss.hpp>

namespace vibrotrough::theory {
namespace {

/// The relative velocity within a phase: v = at_start - b (cos t - cos start) - c (t - start).
struct PhaseVelocity {
    double start, at_start, b, c;

    double at(double t) const { return at_start - b * (std::cos(t) - std::cos(start)) - c * (t - start); }
};

bool is_positive(PhaseKind kind) {
    return kind == PhaseKind::positive_slide || kind == PhaseKind::positive_slide_after_landing;
}

PhaseVelocity velocity_in(Phase const& phase, PointMass const& p) {
    double const slope = p.tan_inclination * p.tan_vibration_angle / p.throw_number;
    PhaseVelocity v{phase.start, 0, 0, 0};
    if (phase.kind == PhaseKind::rest) return v;
    if (phase.kind == PhaseKind::flight) {
        v.b = 1;
        v.c = slope;
    } else {
        double const friction = (is_positive(phase.kind) ? 1 : -1) * p.friction * p.tan_vibration_angle;
        v.b = 1 + friction;
        v.c = slope + friction / p.throw_number;
    }
    double const duration = phase.end - phase.start;
    if (duration < 1e-9) return v;
    // The displacement is the integral of at(t) over the phase.
    double const rest = v.b * (std::cos(v.start) * duration - std::sin(phase.end) + std::sin(v.start)) -
                        v.c * duration * duration / 2;
    v.at_start = (phase.relative_displacement - rest) / duration;
    return v;
}

/// Work lost to friction in a slide, in (omega r)^2 sin(beta) cos(beta).
double friction_loss(Phase const& phase, PhaseVelocity const& v, PointMass const& p) {
    return boost::math::quadrature::gauss<double, 15>::integrate(
        [&](double t) { return p.friction * (1 / p.throw_number - std::sin(t)) * std::abs(v.at(t)); },
        phase.start, phase.end);
}

}  // namespace

PlasticQuantities plastic_quantities(Motion const& motion, PointMass const& p, Machine const& machine) {
    if (motion.outcome != Outcome::periodic || motion.phases.empty())
        throw std::invalid_argument("the motion is not periodic: " + to_string(motion.outcome));
    double const beta = std::atan(p.tan_vibration_angle), omega = angular_frequency(p, machine);
    double const along = std::cos(beta), normal = std::sin(beta);
    double hardest = 0, loss = 0;  // in omega r, and in (omega r)^2 per period
    std::size_t const count = motion.phases.size();
    for (std::size_t i = 0; i < count; ++i) {
        Phase const& phase = motion.phases[i];
        PhaseVelocity const v = velocity_in(phase, p);
        if (phase.kind == PhaseKind::flight) {
            double const approach =
                std::cos(phase.end) - std::cos(phase.start) + (phase.end - phase.start) / p.throw_number;
            double const before = v.at(phase.end);
            Phase const& next = motion.phases[(i + 1) % count];
            double const after = velocity_in(next, p).at_start;
            hardest = std::max(hardest, std::hypot(approach * normal, before * along));
            loss += (std::pow(approach * normal, 2) + (before * before - after * after) * along * along) / 2;
        } else if (phase.kind != PhaseKind::rest) {
            loss += friction_loss(phase, v, p) * normal * along;
        }
    }
    double const period = 2 * std::numbers::pi * motion.period_cycles;  // in 1/omega
    double const slope = p.tan_inclination * p.tan_vibration_angle / p.throw_number;
    double const lift = motion.velocity_efficiency * period * slope * along * along;
    double const speed = omega * machine.amplitude;
    return {hardest * speed, (loss + lift) * speed * speed * omega / period};
}

}  // namespace vibrotrough::theory
