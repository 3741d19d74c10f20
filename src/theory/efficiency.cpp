#include "theory/efficiency.hpp"

#include "theory/detail/common/input_check.hpp"
#include "theory/detail/common/weak_forces.hpp"
#include "theory/detail/conveyor/check.hpp"
#include "theory/detail/conveyor/solver.hpp"
#include "theory/detail/plastic/contact.hpp"
#include "theory/detail/plastic/flight.hpp"
#include "theory/detail/plastic/steady_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrotrough::theory {
namespace {

using detail::Instant;
using detail::Law;

constexpr int bits = 3, longest_mode = 21;
/// The mode of one period.
struct ModeOfPeriod {
    ModeCode code = 0;
    int length = 0;

    void clear() { *this = {}; }
    void add(PhaseKind kind, Instant, Instant, double) { code = append_phase(code, kind, length++); }
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
    detail::ConveyorSolver conveyors;

    std::optional<Efficiency> solve_periodic(PointMass const& input);
};

/// Nothing for motions without a period.
std::optional<Efficiency> EfficiencySolver::Memory::solve_periodic(PointMass const& input) {
    if (std::abs(input.tan_inclination) > input.friction || input.friction == 0) {
        Motion const motion = theory::solve(input);
        return Efficiency{motion.velocity_efficiency, 0, 0, motion.outcome};
    }
    Law const law = detail::make_law(input);
    bool const flies = input.throw_number > 1;
    if (flies && input.throw_number != throw_number) {
        throw_number = 0;  // stays so if the next line throws
        detail::find_normal_motion(input.throw_number, normal);
        throw_number = input.throw_number;
    }
    if (flies && normal.cycles == 0) return std::nullopt;
    if (!flies) {
        throw_number = 0;
        if (!detail::start_at_slide(law, normal))
            return Efficiency{0, append_phase(0, PhaseKind::rest, 0), 1, Outcome::periodic};
    }
    ModeOfPeriod mode;
    detail::SteadyMotion const steady = detail::find_steady_motion(law, normal, mode);
    ModeCode const code = !flies && steady.v != 0 ? joined(mode.code, mode.length) : mode.code;
    return Efficiency{steady.eta, code, normal.cycles, Outcome::periodic};
}

EfficiencySolver::EfficiencySolver() : memory_(std::make_unique<Memory>()) {}
EfficiencySolver::~EfficiencySolver() = default;
EfficiencySolver::EfficiencySolver(EfficiencySolver&&) noexcept = default;
EfficiencySolver& EfficiencySolver::operator=(EfficiencySolver&&) noexcept = default;

Efficiency EfficiencySolver::operator()(PointMass const& input) {
    detail::check_ranges(input);
    try {
        if (auto const answer = memory_->solve_periodic(detail::with_noticeable_forces(input)))
            return *answer;
    } catch (PhaseError const& error) {
        throw PhaseError(std::string(error.what()) + " (" + detail::inputs_text(input) + ")");
    }
    Conveyor conveyor{};
    conveyor.point = input;
    return solve(conveyor);
}

Efficiency EfficiencySolver::solve(Conveyor const& input) {
    detail::check_ranges(input);
    return memory_->conveyors(input);
}

}  // namespace vibrotrough::theory
