#include "theory/point_mass.hpp"

#include "theory/detail/common/input_check.hpp"
#include "theory/detail/common/weak_forces.hpp"
#include "theory/detail/plastic/contact.hpp"
#include "theory/detail/plastic/flight.hpp"
#include "theory/detail/plastic/orbit.hpp"
#include "theory/detail/plastic/steady_motion.hpp"
#include "theory/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace vibrotrough::theory {
namespace {

using detail::Instant;
using detail::PlasticOrbit;
using detail::two_pi;

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

struct PhasesOfPeriod {
    std::vector<Phase> all;

    void clear() { all.clear(); }
    void add(PhaseKind kind, Instant from, Instant to, double displacement) {
        all.push_back({kind, from.t, to.t, displacement});
    }
};

void describe(Motion& motion) {
    double const shift = two_pi * std::floor(motion.phases.front().start / two_pi);
    for (Phase& phase : motion.phases) {
        phase.start -= shift;
        phase.end -= shift;
        motion.mode += to_string(phase.kind);
        if (phase.kind == PhaseKind::flight) {
            motion.flight_number = std::max(motion.flight_number, (phase.end - phase.start) / two_pi);
        }
    }
}

/// Sets the motion and the velocity of an orbit whose normal motion is periodic.
void solve_along(PlasticOrbit& orbit) {
    PhasesOfPeriod phases;
    auto const [v, eta] = detail::find_steady_motion(orbit.law, orbit.normal, phases);
    orbit.velocity = v;
    if (orbit.starts_within_slide()) {
        detail::start_at_first_slide(phases.all, [](Phase& first, Phase const& last) {
            first.relative_displacement += last.relative_displacement;
        });
    }
    orbit.motion = {.velocity_efficiency = eta,
                    .mode = "",
                    .phases = std::move(phases.all),
                    .flight_number = 0,
                    .period_cycles = orbit.normal.cycles,
                    .converged = true,
                    .outcome = Outcome::periodic};
    describe(orbit.motion);
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
        orbit.motion.outcome = Outcome::unsettled;
    } else if (!flies && !detail::start_at_slide(orbit.law, orbit.normal)) {
        orbit.motion = resting_motion();
    } else {
        solve_along(orbit);
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
    Conveyor conveyor{};
    conveyor.point = input;
    return solve_plastic(conveyor, Detail::motion).motion;
}

}  // namespace vibrotrough::theory
