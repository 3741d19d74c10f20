#include "theory/detail/rolling/search.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory::detail {
namespace {

// omega r cos(beta): the distance to the state that repeats, and the change in a plain period where phases
// that are about to appear keep Newton's method from settling.
constexpr double newton_settled = 1e-13, plain_settled = 1e-11;
constexpr int most_newton_steps = 12, most_attempts = 150, periods_between = 20;

double size(RollingState const& s) {
    return std::sqrt(s.v * s.v + s.w * s.w);
}

/// Whether a motion that repeats can have this state. @param most  RollingWalk::greatest_velocity()
bool is_possible(RollingState const& s, double most) {
    return std::abs(s.v) <= most && std::abs(s.w) <= most;
}

/// How the state after a period depends on that before, by differences: behind a rigid landing.
RollingSensitivity by_differences(RollingWalk const& walk, RollingNormal const& normal, RollingState s,
                                  RollingState const& next) {
    constexpr double step = 1e-7;
    RollingState const v = walk.follow(normal, {s.v + step, s.w}, nullptr);
    RollingState const w = walk.follow(normal, {s.v, s.w + step}, nullptr);
    return {{(v.v - next.v) / step, (w.v - next.v) / step}, {(v.w - next.w) / step, (w.w - next.w) / step}};
}

}  // namespace

bool RollingSearch::newton(RollingWalk const& walk, RollingNormal const& normal, RollingState& s, double most,
                           RollingWalk::Record& record) const {
    for (int i = 0; i < most_newton_steps; ++i) {
        RollingSensitivity by{};
        RollingState const next = walk.follow(normal, s, &record, &by);
        if (!by.known) by = by_differences(walk, normal, s, next);
        // (1 - derivative) step = change
        double const a = 1 - by.v.v, b = -by.v.w, c = -by.w.v, d = 1 - by.w.w;
        double const determinant = a * d - b * c;
        if (!(std::abs(determinant) > 1e-6)) return false;
        RollingState const change{next.v - s.v, next.w - s.w};
        RollingState const step{(d * change.v - b * change.w) / determinant,
                                (a * change.w - c * change.v) / determinant};
        if (size(step) <= newton_settled * (1 + std::abs(next.v))) return true;
        s = {s.v + step.v, s.w + step.w};
        if (!is_possible(s, most)) return false;
    }
    return false;
}

bool RollingSearch::settle(RollingWalk const& walk, RollingNormal const& normal,
                           RollingWalk::Record& record) {
    // The next layer probably changes as much as the last one.
    double const most = walk.greatest_velocity(normal.pieces.back().end - normal.pieces.front().start);
    RollingState guess{2 * state_.v - before_.v, 2 * state_.w - before_.w};
    if (!is_possible(guess, most)) guess = {};
    RollingState s = guess;
    bool repeats = newton(walk, normal, s, most, record);
    if (!repeats) guess = {};
    for (int i = 0; i < most_attempts && !repeats; ++i) {
        for (int k = 0; k < periods_between; ++k) guess = walk.follow(normal, guess, nullptr);
        s = guess;
        repeats = newton(walk, normal, s, most, record);
        if (repeats) break;
        s = walk.follow(normal, guess, &record);
        repeats = size({s.v - guess.v, s.w - guess.w}) <= plain_settled * (1 + std::abs(s.v));
    }
    before_ = repeats ? state_ : RollingState{};
    state_ = repeats ? s : RollingState{};
    return repeats;
}

}  // namespace vibrotrough::theory::detail
