#include "theory/efficiency.hpp"

#include "theory/detail/ranges.hpp"
#include "theory/detail/solver.hpp"

namespace vibrotrough::theory {
namespace {

constexpr int bits = 3, longest_mode = 21;

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
    detail::ConveyorSolver solver;
    Conveyor conveyor{};  // nothing beyond the plastic point mass is set
};

EfficiencySolver::EfficiencySolver() : memory_(std::make_unique<Memory>()) {}
EfficiencySolver::~EfficiencySolver() = default;
EfficiencySolver::EfficiencySolver(EfficiencySolver&&) noexcept = default;
EfficiencySolver& EfficiencySolver::operator=(EfficiencySolver&&) noexcept = default;

Efficiency EfficiencySolver::operator()(PointMass const& input) {
    memory_->conveyor.point = input;
    return solve(memory_->conveyor);
}

Efficiency EfficiencySolver::solve(Conveyor const& input) {
    detail::check_ranges(input);
    return memory_->solver(input);
}

}  // namespace vibrotrough::theory
