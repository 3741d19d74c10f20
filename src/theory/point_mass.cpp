#include "theory/point_mass.hpp"

#include "theory/detail/contact.hpp"
#include "theory/detail/flight.hpp"
#include "theory/detail/input_check.hpp"
#include "theory/detail/periodic.hpp"
#include "theory/detail/plastic_orbit.hpp"
#include "theory/detail/weak_forces.hpp"
#include "theory/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace vibrotrough::theory {
namespace {

using detail::Instant;
using detail::Law;
using detail::NormalMotion;
using detail::PlasticOrbit;
using detail::two_pi;

constexpr double shortest_phase = 1e-12;  // rad; shorter phases are rounding errors, not motion

Motion resting_motion() {
    return {.velocity_efficiency = 0,
            .mode = "R",
            .phases = {{PhaseKind::rest, 0, two_pi, 0}},
            .flight_number = 0,
            .period_cycles = 1,
            .converged = true,
            .outcome = Outcome::periodic};
}

Motion endless_motion(PointMass const& input) {
    bool const level = input.tan_inclination == 0;
    double const infinity = std::numeric_limits<double>::infinity();
    return {.velocity_efficiency = level ? 0 : std::copysign(infinity, -input.tan_inclination),
            .mode = "",
            .phases = {},
            .flight_number = 0,
            .period_cycles = 0,
            .converged = false,
            .outcome = level ? Outcome::indifferent : Outcome::runs_away};
}

std::vector<Phase> record_period(Law const& law, NormalMotion const& normal, double v) {
    std::vector<Phase> phases;
    detail::Hints hints;
    detail::follow_period(law, normal, v, hints,
                          [&](PhaseKind kind, Instant from, Instant to, double displacement, double) {
                              if (to.t - from.t > shortest_phase)
                                  phases.push_back({kind, from.t, to.t, displacement});
                          });
    return phases;
}

void describe(Motion& motion, double length) {
    double const shift = two_pi * std::floor(motion.phases.front().start / two_pi);
    double displacement = 0;
    for (Phase& phase : motion.phases) {
        phase.start -= shift;
        phase.end -= shift;
        displacement += phase.relative_displacement;
        motion.mode += to_string(phase.kind);
        if (phase.kind == PhaseKind::flight) {
            motion.flight_number = std::max(motion.flight_number, (phase.end - phase.start) / two_pi);
        }
    }
    motion.velocity_efficiency = displacement / length;
}

/// The result when no period was found: the mean over the second half of the flights followed.
Motion unsettled_motion(Law const& law, NormalMotion const& normal) {
    double const middle = (normal.start.t + normal.end.t) / 2;
    double displacement = 0, time = 0;
    detail::Hints hints;
    detail::follow_period(law, normal, 0, hints,
                          [&](PhaseKind, Instant from, Instant to, double moved, double) {
                              if (from.t < middle) return;
                              displacement += moved;
                              time += to.t - from.t;
                          });
    return {.velocity_efficiency = displacement / time,
            .mode = "",
            .phases = {},
            .flight_number = 0,
            .period_cycles = 0,
            .converged = false,
            .outcome = Outcome::unsettled};
}

/// Without a flight: moves the start of the period from within a slide to the start of the positive slide, or
/// of the negative slide if there is no positive one. @return whether it did
bool start_at_first_slide(Motion& motion, Law const& law, NormalMotion& normal) {
    for (auto const first : {PhaseKind::positive_slide, PhaseKind::negative_slide}) {
        for (Phase const& phase : motion.phases) {
            if (phase.kind != first || phase.start == normal.start.t) continue;
            normal.start = Instant::at(phase.start);
            normal.end = normal.start;
            normal.end.t += two_pi;
            motion.phases = record_period(law, normal, 0);
            return true;
        }
    }
    return false;
}

/// @return the velocity at the start of the recorded period
double solve_along(PlasticOrbit& orbit, bool flies) {
    Law const& law = orbit.law;
    NormalMotion& normal = orbit.normal;
    Motion& motion = orbit.motion;
    detail::Hints hints;
    auto const ignore = [](PhaseKind, Instant, Instant, double, double) {};
    auto const period = [&](double v0) { return detail::follow_period(law, normal, v0, hints, ignore); };
    double const start = detail::fixed_point(period, 0, 0).v;
    motion = {.velocity_efficiency = 0,
              .mode = "",
              .phases = record_period(law, normal, start),
              .flight_number = 0,
              .period_cycles = normal.cycles,
              .converged = true,
              .outcome = Outcome::periodic};
    bool const moved = !flies && start != 0 && start_at_first_slide(motion, law, normal);
    describe(motion, normal.end.t - normal.start.t);
    return moved ? 0 : start;
}

PlasticOrbit solve_checked(PointMass const& input) {
    PlasticOrbit orbit{.law = detail::make_law(input)};
    if (std::abs(input.tan_inclination) > input.friction || input.friction == 0) {
        orbit.motion = endless_motion(input);
        return orbit;
    }
    bool const flies = input.throw_number > 1;
    if (flies) detail::find_normal_motion(input.throw_number, orbit.normal);
    if (flies && orbit.normal.cycles == 0) {
        orbit.motion = unsettled_motion(orbit.law, orbit.normal);
    } else if (!flies && !detail::start_at_slide(orbit.law, orbit.normal)) {
        orbit.motion = resting_motion();
    } else {
        orbit.velocity = solve_along(orbit, flies);
    }
    return orbit;
}

}  // namespace

std::string to_string(PhaseKind kind) {
    switch (kind) {
        case PhaseKind::positive_slide:
            return "P";
        case PhaseKind::negative_slide:
            return "N";
        case PhaseKind::rest:
            return "R";
        case PhaseKind::flight:
            return "F";
        case PhaseKind::positive_slide_after_landing:
            return "P'";
        case PhaseKind::negative_slide_after_landing:
            return "N'";
    }
    throw std::invalid_argument("this is not a phase");
}

std::string to_string(Outcome outcome) {
    switch (outcome) {
        case Outcome::periodic:
            return "the motion is periodic";
        case Outcome::runs_away:
            return "the mass runs away downhill: gravity is stronger than friction, so there is no steady "
                   "speed";
        case Outcome::indifferent:
            return "without friction on a level trough no force drives the mass: it keeps its initial speed";
        case Outcome::unsettled:
            return "no period was found: the efficiency is a mean over the simulated cycles";
    }
    throw std::invalid_argument("this is not an outcome");
}

double machine_number(PointMass const& input) {
    double const b = input.tan_vibration_angle, a = input.tan_inclination;
    return input.throw_number * std::sqrt(1 + b * b) / b / std::sqrt(1 + a * a);  // cos(alpha) / sin(beta)
}

namespace detail {

PlasticOrbit solve_orbit(PointMass const& input) {
    check_ranges(input);
    try {
        return solve_checked(with_noticeable_forces(input));
    } catch (PhaseError const& error) {
        throw PhaseError(std::string(error.what()) + " (" + inputs_text(input) + ")");
    }
}

}  // namespace detail

Motion solve(PointMass const& input) {
    return detail::solve_orbit(input).motion;
}

}  // namespace vibrotrough::theory
