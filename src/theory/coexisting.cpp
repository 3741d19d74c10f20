#include "theory/coexisting.hpp"

#include "theory/detail/ranges.hpp"
#include "theory/detail/solver.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory {
namespace {

using detail::Instant;
using detail::MotionStart;
using detail::two_pi;

constexpr double same_efficiency = 1e-6;
constexpr std::size_t none = static_cast<std::size_t>(-1);

double part_of_one(double x) {
    return x - std::floor(x);
}

MotionStart start_number(int k, double fastest_rebound, double fastest_slip) {
    constexpr double p = 1.2207440846057596;  // p^4 = p + 1
    double const t = two_pi * part_of_one(0.5 + k / p);
    double const rebound = fastest_rebound * part_of_one(0.5 + k / (p * p));
    double const slip = fastest_slip * (2 * part_of_one(0.5 + k / (p * p * p)) - 1);
    return {Instant::at(t), rebound, slip};
}

bool same_motion(Efficiency const& a, Efficiency const& b) {
    if (a.outcome != b.outcome) return false;
    double const eta = a.velocity_efficiency, other = b.velocity_efficiency;
    if (a.outcome == Outcome::runs_away) return eta == other;
    if (a.outcome != Outcome::periodic) return true;
    int const longer = std::max(a.period_cycles, b.period_cycles);
    int const shorter = std::min(a.period_cycles, b.period_cycles);
    return longer % shorter == 0 && std::abs(eta - other) <= same_efficiency * (1 + std::abs(eta));
}

}  // namespace

struct MotionSurvey::Memory {
    detail::ConveyorSolver solver;
    std::vector<std::size_t> after_zero;  // motion after a take-off at each zero of the normal force

    void note_zeros(std::size_t motion);
};

/// With one friction coefficient, what follows a take-off from contact does not depend on what was before.
void MotionSurvey::Memory::note_zeros(std::size_t motion) {
    detail::NormalOrbit const& orbit = solver.orbit();
    after_zero.resize(orbit.left_at.size(), none);
    if (!solver.forces().one_friction()) return;
    for (std::size_t i = 0; i < orbit.left_at.size(); ++i) {
        if (orbit.left_at[i] != none && after_zero[i] == none) after_zero[i] = motion;
    }
}

MotionSurvey::MotionSurvey() : memory_(std::make_unique<Memory>()) {}
MotionSurvey::~MotionSurvey() = default;
MotionSurvey::MotionSurvey(MotionSurvey&&) noexcept = default;
MotionSurvey& MotionSurvey::operator=(MotionSurvey&&) noexcept = default;

std::vector<CoexistingMotion> MotionSurvey::operator()(Conveyor const& conveyor, Efficiency const& standard,
                                                       int starts) {
    using Mean = detail::ConveyorSolver::Mean;
    detail::check_ranges(conveyor);
    std::vector<CoexistingMotion> found{{standard, 1}};
    detail::ConveyorSolver& solver = memory_->solver;
    memory_->after_zero.clear();
    solver(conveyor, {}, Mean::left_out);
    if (standard.outcome == Outcome::indifferent) return found;
    memory_->note_zeros(0);
    bool const one_friction = solver.forces().one_friction();
    // A mass that cannot rebound stays on a trough that never falls away from it.
    if (one_friction && conveyor.restitution == 0 && solver.forces().presses().none()) return found;
    double const e = conveyor.restitution;
    double const fastest = 2 * e / (1 - e) * solver.forces().vy().bound();
    double const slip = 2 * solver.forces().vx().bound();
    for (int k = 1; k < starts; ++k) {
        MotionStart const start = start_number(k, fastest, slip);
        try {
            Efficiency answer =
                solver(conveyor, start, Mean::left_out, one_friction ? &memory_->after_zero : nullptr);
            std::size_t which = solver.joined();
            for (std::size_t i = 0; i < found.size() && which == none; ++i) {
                if (same_motion(found[i].motion, answer)) which = i;
            }
            if (which == none) {
                if (answer.outcome == Outcome::unsettled) answer = solver(conveyor, start, Mean::wanted);
                which = found.size();
                found.push_back({answer, 0});
            }
            memory_->note_zeros(which);
            found[which].share += 1;
        } catch (PhaseError const&) {
            continue;
        }
    }
    double all = 0;
    for (CoexistingMotion const& one : found) all += one.share;
    for (CoexistingMotion& one : found) one.share /= all;
    std::stable_sort(found.begin() + 1, found.end(),
                     [](auto const& a, auto const& b) { return a.share > b.share; });
    return found;
}

Efficiency efficiency_of(ConveyorMotion const& m) {
    return {m.motion.velocity_efficiency, mode_code(m.motion), m.motion.period_cycles, m.motion.outcome,
            m.half_width};
}

}  // namespace vibrotrough::theory
