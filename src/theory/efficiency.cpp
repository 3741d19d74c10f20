#include "theory/efficiency.hpp"

#include "theory/detail/contact.hpp"
#include "theory/detail/conveyor_check.hpp"
#include "theory/detail/conveyor_efficiency.hpp"
#include "theory/detail/flight.hpp"
#include "theory/detail/input_check.hpp"
#include "theory/detail/periodic.hpp"
#include "theory/detail/weak_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrotrough::theory {
namespace {

using detail::Instant;
using detail::Law;

constexpr int bits = 3, longest_mode = 21;
constexpr double shortest_phase = 1e-12;  // rad, as in solve()

// The last Newton step is added to first order instead of being evaluated again; the error is its square.
constexpr double velocity_tolerance = 3e-6;

/// Adds up one period: the displacement, its derivative with respect to the starting velocity, and the mode.
struct Tally {
    double displacement = 0, derivative = 0;
    ModeCode mode = 0;
    int length = 0;

    void operator()(PhaseKind kind, Instant from, Instant to, double moved, double slope) {
        double const h = to.t - from.t;
        displacement += moved;
        derivative += slope * h;  // the time of a stop changes too, but the speed is zero there
        if (h > shortest_phase) mode = append_phase(mode, kind, length++);
    }
};

/// Without a flight the period may start within a slide. Its first piece then continues its last one, and the
/// mode starts with the positive slide, or with the negative one if there is no positive slide.
ModeCode joined(ModeCode mode, int length) {
    if (length < 2) return mode;
    mode >>= bits;
    --length;
    for (auto const first : {PhaseKind::positive_slide, PhaseKind::negative_slide}) {
        for (int i = 0; i < std::min(length, longest_mode); ++i) {
            if (((mode >> (bits * i)) & 7) != static_cast<ModeCode>(first) + 1) continue;
            ModeCode const head = mode & ((ModeCode{1} << (bits * i)) - 1);
            return (mode >> (bits * i)) | (head << (bits * (length - i)));
        }
    }
    return mode;
}

}  // namespace

ModeCode append_phase(ModeCode code, PhaseKind kind, int length) {
    if (length >= longest_mode) return code | (ModeCode{7} << (bits * (longest_mode - 1)));
    return code | ((static_cast<ModeCode>(kind) + 1) << (bits * length));
}

ModeCode mode_code(Motion const& motion) {
    ModeCode code = 0;
    int length = 0;
    for (Phase const& phase : motion.phases) code = append_phase(code, phase.kind, length++);
    return code;
}

std::string to_string(ModeCode code) {
    std::string text;
    for (; code != 0; code >>= bits) {
        auto const letter = static_cast<int>(code & 7);
        text += letter == 7 ? ".." : to_string(static_cast<PhaseKind>(letter - 1));
    }
    return text;
}

struct EfficiencySolver::Memory {
    double throw_number = 0;  // that `normal` belongs to
    detail::NormalMotion normal;
    detail::Hints hints;
    double v = 0, v_before = 0;  // velocity at the start of the period for the last two points
    ModeCode mode = 0, mode_before = 0;
    detail::ConveyorEfficiency conveyors;

    /// A first guess: linear extrapolation from the last two points if they changed by similar amounts.
    double guess(bool flies) const {
        bool const flew = mode != 0 && static_cast<int>(mode & 7) == static_cast<int>(PhaseKind::flight) + 1;
        if (flew != flies) return 0;
        return mode == mode_before ? 2 * v - v_before : v;
    }
    Efficiency solve_periodic(PointMass const& input);
    Efficiency without_period(PointMass const& input);
};

// Motions without a period are rare: leave them to solve().
Efficiency EfficiencySolver::Memory::without_period(PointMass const& input) {
    Motion const motion = theory::solve(input);
    return {motion.velocity_efficiency, 0, motion.period_cycles, motion.outcome};
}

Efficiency EfficiencySolver::Memory::solve_periodic(PointMass const& input) {
    if (std::abs(input.tan_inclination) > input.friction || input.friction == 0) return without_period(input);
    Law const law = detail::make_law(input);
    bool const flies = input.throw_number > 1;
    if (flies && input.throw_number != throw_number) {
        throw_number = 0;  // stays so if the next line throws
        detail::find_normal_motion(input.throw_number, normal);
        throw_number = input.throw_number;
    }
    if (flies && normal.cycles == 0) return without_period(input);
    if (!flies) {
        throw_number = 0;
        if (!detail::start_at_slide(law, normal)) {
            return {0, append_phase(0, PhaseKind::rest, 0), 1, Outcome::periodic};
        }
    }
    Tally tally;
    auto const period = [&](double v0) {
        tally = {};
        return detail::follow_period(law, normal, v0, hints, tally);
    };
    auto start = detail::fixed_point(period, guess(flies), velocity_tolerance);
    if (!flies && start.v != 0 && std::abs(start.v + start.error) <= velocity_tolerance) {
        start =
            detail::fixed_point(period, 0, velocity_tolerance);  // exact if there is a rest before the slide
    }
    v_before = v;
    v = start.v + start.error;
    mode_before = mode;
    mode = !flies && start.v != 0 ? joined(tally.mode, tally.length) : tally.mode;
    double const displacement = tally.displacement + tally.derivative * start.error;
    return {displacement / (normal.end.t - normal.start.t), mode, normal.cycles, Outcome::periodic};
}

EfficiencySolver::EfficiencySolver() : memory_(std::make_unique<Memory>()) {}
EfficiencySolver::~EfficiencySolver() = default;
EfficiencySolver::EfficiencySolver(EfficiencySolver&&) noexcept = default;
EfficiencySolver& EfficiencySolver::operator=(EfficiencySolver&&) noexcept = default;

Efficiency EfficiencySolver::operator()(PointMass const& input) {
    detail::check_ranges(input);
    try {
        return memory_->solve_periodic(detail::with_noticeable_forces(input));
    } catch (PhaseError const& error) {
        throw PhaseError(std::string(error.what()) + " (" + detail::inputs_text(input) + ")");
    }
}

Efficiency EfficiencySolver::solve(Conveyor const& input) {
    detail::check_ranges(input);
    auto const quick = memory_->conveyors(detail::with_noticeable_forces(input));
    if (quick) return *quick;
    ConveyorMotion const m = theory::solve(input);
    return {m.motion.velocity_efficiency, mode_code(m.motion), m.motion.period_cycles, m.motion.outcome,
            m.half_width};
}

}  // namespace vibrotrough::theory
