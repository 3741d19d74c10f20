#include "theory/detail/rolling/search.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory::detail {
namespace {

constexpr double state_settled = 1e-11;   // omega r cos(beta): change of the state from period to period
constexpr int most_map_periods = 3000;    // of the map, before a mean is given instead
constexpr double newton_settled = 1e-13;  // omega r cos(beta): the distance to the state that repeats
constexpr int most_newton_steps = 12;

double size(RollingState const& s) {
    return std::sqrt(s.v * s.v + s.w * s.w);
}

/// Whether a motion that repeats can have this state. @param most  RollingWalk::greatest_velocity()
bool is_possible(RollingState const& s, double most) {
    return std::abs(s.v) <= most && std::abs(s.w) <= most;
}

/// Goes from period to period by Broyden's method. @return whether the state repeats
bool broyden(RollingWalk const& walk, RollingNormal const& normal, double most, RollingState& s) {
    BroydenSearch search;
    bool close = false;
    for (int i = 0; i < most_map_periods; ++i) {
        RollingState const next = walk.follow(normal, s, nullptr), change{next.v - s.v, next.w - s.w};
        double const scale = state_settled * (1 + std::abs(next.v));
        if (i % 100 == 99) search = BroydenSearch{};
        RollingState const proposed = search.propose(s, change);
        bool const plain = i % 100 >= 80;
        s = plain ? next : proposed;
        // One more period makes the answer independent of where the search began.
        if (close || size(change) <= 1e-3 * scale) return true;
        close = size(change) <= scale && search.distance() <= 10 * scale;
        if (plain || !is_possible(s, most)) search = BroydenSearch{};
        // At states far away a change is lost in rounding and would seem to be none.
        s = {std::clamp(s.v, -most, most), std::clamp(s.w, -most, most)};
    }
    return false;
}

}  // namespace

RollingState BroydenSearch::propose(RollingState s, RollingState change) {
    double const now = size(change);
    if (known_ && now > 4 * size(change_)) *this = BroydenSearch{};
    if (known_) update({change.v - change_.v, change.w - change_.w});
    change_ = change;
    // The step is -(inverse Jacobian) change, at first the change itself.
    step_ = {-(a_ * change.v + b_ * change.w), -(c_ * change.v + d_ * change.w)};
    double const most = known_ ? 4 * std::max(last_, now) : now, length = size(step_);
    if (length > most) step_ = {step_.v * most / length, step_.w * most / length};
    last_ = size(step_);
    known_ = true;
    return {s.v + step_.v, s.w + step_.w};
}

double BroydenSearch::distance() const {
    return size(step_);
}

/// Broyden's update of the inverse Jacobian for a step that changed the change by y.
void BroydenSearch::update(RollingState y) {
    RollingState const hy{a_ * y.v + b_ * y.w, c_ * y.v + d_ * y.w};
    double const scale = step_.v * hy.v + step_.w * hy.w;
    if (!(std::abs(scale) > 1e-9 * (step_.v * step_.v + step_.w * step_.w))) {
        a_ *= 2;  // the change does not depend on the state: go further
        d_ *= 2;
        return;
    }
    RollingState const miss{(step_.v - hy.v) / scale, (step_.w - hy.w) / scale};
    RollingState const row{step_.v * a_ + step_.w * c_, step_.v * b_ + step_.w * d_};
    a_ += miss.v * row.v;
    b_ += miss.v * row.w;
    c_ += miss.w * row.v;
    d_ += miss.w * row.w;
}

bool RollingSearch::newton(RollingWalk const& walk, RollingNormal const& normal, RollingState& s, double most,
                           RollingWalk::Record& record) const {
    for (int i = 0; i < most_newton_steps; ++i) {
        RollingSensitivity by{};
        RollingState const next = walk.follow(normal, s, &record, &by);
        if (!by.known) return false;
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
    if (!repeats) {
        s = guess;
        repeats = broyden(walk, normal, most, s);
        walk.follow(normal, s, &record);
    }
    before_ = repeats ? state_ : RollingState{};
    state_ = repeats ? s : RollingState{};
    return repeats;
}

}  // namespace vibrotrough::theory::detail
