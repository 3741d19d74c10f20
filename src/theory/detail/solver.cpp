#include "theory/detail/solver.hpp"

#include "theory/detail/fixed_point.hpp"
#include "theory/detail/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace vibrotrough::theory::detail {
namespace {

// The last Newton step is added to first order. It is so small that it changes neither the mode nor the sum
// of the phases.
constexpr double velocity_tolerance = 1e-13;
// Per period, of a mass that runs away: the smaller one of this change of velocity and this share of
// gravity's.
constexpr double least_drift = 1e-9, least_share = 2e-3;
constexpr double settled = 1e-11;  // change of the velocity from period to period
constexpr double least_linear =
    1e-6;                           // error of the velocity up to which Newton's last step is taken as exact
constexpr double idle = 1e-9;       // share of gravity's pull by which friction may miss it as if it held it
constexpr int longest_period = 64;  // cycles, by the rule of Table 1
constexpr int most_periods = 3000;  // from rest
constexpr double repeat_match = 5e-10;  // of displacement and impact energy per cycle, period to period

bool is_standard(MotionStart const& start) {
    return start.at.t == 0 && start.rebound == 0 && start.v == 0;
}

}  // namespace

/// One period from velocity v at its start; notes the phases and adds up the displacement.
Tangent ConveyorSolver::follow_period(double v) {
    notes_.clear();
    displacement_ = derivative_ = 0;
    hints_.restart();
    std::size_t hop = orbit_.first;
    auto const record = [&](PhaseKind kind, double from, double to, double speed, double moved,
                            double derivative) {
        displacement_ += moved;
        derivative_ += derivative;
        notes_.add(kind, hop, from, to, speed, moved);
    };
    ContactLaw const law(forces_);
    Tangent s{v, 1};
    if (orbit_.in_contact) {
        Instant const end{start_.t + two_pi, start_.sine, start_.cosine};
        s = follow_contact(law, s, start_, end, false, hints_, record);
    } else {
        for (; hop < orbit_.hops.size(); ++hop)
            s = follow_hop(law, orbit_.hops[hop], leaps_[hop], s, hints_, record);
    }
    v_ = v;
    slope_ = s.slope;
    return s;
}

/// From the start of the motion to that of the period.
Tangent ConveyorSolver::follow_from_start() {
    auto const ignore = [](PhaseKind, double, double, double, double, double) {};
    ContactLaw const law(forces_);
    Tangent s{from_.v, 0};
    if (orbit_.in_contact && orbit_.hops.empty()) {
        if (from_.at.t == 0) return s;
        return follow_contact(law, s, from_.at, {two_pi, 0, 1}, false, hints_, ignore);
    }
    if (from_.rebound == 0)
        s = follow_contact(law, s, orbit_.begin, orbit_.hops.front().start, false, hints_, ignore);
    for (std::size_t i = 0; i < orbit_.first; ++i)
        s = follow_hop(law, orbit_.hops[i], leaps_[i], s, hints_, ignore);
    return s;
}

/// Without flights the period starts where a slide begins, so that v = 0 is exact if there is a rest before
/// it.
void ConveyorSolver::start_at_slide() {
    Crossings const& forward = forces_.slide(1).starts();
    Crossings const& starts = forward.none() ? forces_.slide(-1).starts() : forward;
    start_ = {0, 0, 1};
    for (std::size_t i = 0; i < starts.count(); ++i) {
        if (!starts.rises(i)) continue;
        start_ = starts.zeros()[i];
        break;
    }
}

/// Whether a mass that changes by `drift` in a period at the slip velocity v runs away: it is so fast that
/// nothing stops it.
bool ConveyorSolver::is_carried_off(double v, double drift) const {
    double const pulled = std::abs(forces_.gravity()) * two_pi * orbit_.cycles;
    double const least = std::min(least_drift, least_share * pulled) * std::abs(v) / fastest();
    return is_fast(v) && drift * v > 0 && !(std::abs(drift) < least);
}

/// Whether v is beyond what any motion that repeats has, and nothing stops the mass.
bool ConveyorSolver::is_fast(double v) const {
    return slope_ == 1 && std::abs(v) > fastest();
}

double ConveyorSolver::fastest() const {
    return 1e4 * (1 + std::abs(forces_.vx().sine) + std::abs(forces_.vx().cosine));
}

/// Whether nothing stops the mass in a period, and gravity and friction cancel each other to within rounding.
bool ConveyorSolver::persists(double v, double drift) const {
    double const pulled = std::abs(forces_.gravity()) * two_pi * orbit_.cycles;
    return slope_ == 1 && std::abs(drift) <= idle * pulled + 1e-15 * (1 + std::abs(v));
}

/// With one friction coefficient the map of the velocity never expands differences.
/// @param from  where the search begins
ConveyorSolver::Search ConveyorSolver::find_fixed_point(double from) {
    bool runs_away = false;
    auto const map = [&](double v) {
        Tangent const after = follow_period(v);
        double const drift = after.v - v;
        if (is_carried_off(v, drift)) {
            runs_away = true;
            return Tangent{v, 0};
        }
        // Where friction holds exactly what gravity pulls, any velocity persists at which nothing stops the
        // mass. From rest it comes to the slowest of them.
        bool const idles = persists(v, drift) && v * forces_.gravity() < 0;
        return idles || is_fast(v) ? Tangent{v - std::copysign(1 + std::abs(v), v), 0} : after;
    };
    FixedPoint const found = fixed_point(map, from, velocity_tolerance);
    if (runs_away) return Search::runs_away;
    error_ = slope_ < 1 ? found.error : 0;
    return Search::found;
}

/// With a larger static friction there can be several periodic motions. The map of the velocity is monotone:
/// from rest it goes to the nearest one.
ConveyorSolver::Search ConveyorSolver::iterate_from_start() {
    double v = follow_from_start().v;
    ModeCode before = 0;
    double stride = 1, last = v, last_drift = 0;
    for (int i = 0; i < most_periods; ++i) {
        Tangent after = follow_period(v);
        double const drift = after.v - v;
        error_ = 0;
        if (persists(v, drift)) return Search::found;
        if (slope_ < 1 && std::abs(drift) <= settled * (1 + std::abs(v))) {
            error_ = drift / (1 - slope_);
            if (std::abs(error_) <= least_linear * (1 + std::abs(v))) return Search::found;
        }
        // Where nothing stops the mass, the drift is the same at any speed. A stride beyond that is taken
        // back.
        bool const plain =
            slope_ == 1 && (stride == 1 || std::abs(drift - last_drift) <= 1e-9 * (1 + std::abs(v)));
        if (plain) {
            bool const downhill = std::abs(forces_.gravity()) > forces_.kinetic_tangent() * forces_.weight();
            if (downhill && std::abs(v) > 10 && drift * v > 0) return Search::runs_away;
            if (is_carried_off(v, drift)) return Search::runs_away;
            last = v;
            last_drift = drift;
            v += stride * drift;
            stride *= 2;
            before = 0;
            continue;
        }
        if (stride > 2) {
            v = last + last_drift;
            stride = 1;
            continue;
        }
        stride = 1;
        ModeCode const now = notes_.mode(orbit_);
        bool const same = now == before;
        before = now;
        double const newton = v + drift / (1 - slope_);
        if (same && slope_ > 0) {
            Tangent const there = follow_period(newton);
            if (notes_.mode(orbit_) == now && std::abs(there.v - newton) < std::abs(drift) / 2) {
                v = newton;
                continue;
            }
        }
        v = after.v;
    }
    // So slow a change is one by weak forces, beside which it does not matter whether the mass rests where
    // its slip changes direction: the next fixed point is the one.
    return find_fixed_point(v);
}

/// By the rule of Table 1 a faster mass can be slower after a period, so that only following it shows whether
/// it repeats, and after how many periods of its flights.
void ConveyorSolver::iterate_by_rule() {
    std::vector<double> starts;
    double v = follow_from_start().v;
    error_ = 0;
    auto const returns = [&](std::size_t n, double tolerance) {
        return n <= starts.size() && std::abs(v - starts[starts.size() - n]) <= tolerance * (1 + std::abs(v));
    };
    for (int i = 0; i < most_periods; ++i) {
        starts.push_back(v);
        v = follow_period(v).v;
        for (std::size_t n = 1; n * static_cast<std::size_t>(orbit_.cycles) <= longest_period; ++n) {
            // An alternating approach meets the tolerance for 2 periods before it does for 1.
            if (!returns(n, settled) || (n > 1 && returns(1, 1e3 * settled))) continue;
            repeat_orbit(n);
            follow_period(v);
            return;
        }
    }
    throw PhaseError("by the rule of Table 1 for the start of flights, this motion does not repeat");
}

/// Makes the period so many times as long.
void ConveyorSolver::repeat_orbit(std::size_t times) {
    std::size_t const count = orbit_.hops.size() - orbit_.first;
    for (std::size_t i = 0; i < count * (times - 1); ++i) {
        orbit_.hops.push_back(Hop(orbit_.hops[orbit_.first + i]));
        leaps_.push_back(Leap(leaps_[orbit_.first + i]));
    }
    orbit_.cycles *= static_cast<int>(times);
    orbit_known_ = false;
}

/// Whether the next period, with rounding errors of its own, agrees with the one that was found last.
bool ConveyorSolver::repeats() const {
    double moved = 0, impacts = 0;  // energy of the impacts of this period minus that of the next
    auto const add = [&](PhaseKind, double, double, double, double distance, double) { moved += distance; };
    ContactLaw const law(forces_);
    Hints hints;
    Tangent s{v_, 1};
    for (Hop const& hop : orbit_.again) {
        s = follow_hop(law, hop, leap(forces_, hop), s, hints, add);
        impacts -= hop.approach * hop.approach;
    }
    for (std::size_t i = orbit_.first; i < orbit_.hops.size(); ++i)
        impacts += orbit_.hops[i].approach * orbit_.hops[i].approach;
    double const most = repeat_match * two_pi * orbit_.cycles;
    return !orbit_.again.empty() && std::abs(moved - displacement_) < most && std::abs(impacts) < most;
}

Efficiency ConveyorSolver::running_away() const {
    return {std::copysign(std::numeric_limits<double>::infinity(), -forces_.gravity()), 0, 0,
            Outcome::runs_away};
}

/// What follows from the forces alone; nothing when the motion has to be found.
std::optional<Efficiency> ConveyorSolver::without_motion() const {
    if (forces_.drag() > 0) return std::nullopt;
    double const steepest = forces_.steepest_held(!orbit_.in_contact);
    if (std::abs(forces_.conveyor().point.tan_inclination) > steepest) return running_away();
    if (steepest == 0) return Efficiency{0, 0, 0, Outcome::indifferent};
    return std::nullopt;
}

Efficiency ConveyorSolver::solve(Conveyor const& c) {
    forces_.set(c);
    hints_ = {};  // those of another point would change the last bit
    if (!forces_.same_normal() || !orbit_known_) {
        orbit_known_ = false;
        find_normal_orbit(forces_, from_, orbit_, after_zero_);
        // Its first hop is another one when a mean was wanted; and a later point may have another start.
        orbit_known_ = is_standard(from_) && !orbit_.in_doubt;
        if (orbit_.joined != never) return {0, 0, 0, Outcome::unsettled};
    }
    if (auto const known = without_motion()) return *known;
    bool const has_period = orbit_.cycles > 0;
    bool const by_rule = forces_.starts_by_rule(), one_friction = forces_.one_friction() && !by_rule;
    leaps_.resize(orbit_.hops.size());
    if (!has_period) {
        for (std::size_t i = 0; i < orbit_.first; ++i) leaps_[i] = leap(forces_, orbit_.hops[i]);
        return average(orbit_.first);
    }
    for (std::size_t i = one_friction ? orbit_.first : 0; i < orbit_.hops.size(); ++i)
        leaps_[i] = leap(forces_, orbit_.hops[i]);
    start_ = {0, 0, 1};
    if (one_friction && orbit_.in_contact) start_at_slide();
    Search search = Search::found;
    if (by_rule) {
        iterate_by_rule();
    } else {
        search = one_friction ? find_fixed_point(0) : iterate_from_start();
    }
    if (search == Search::found && orbit_.in_doubt && !repeats()) return average(0);
    if (search == Search::runs_away) return running_away();
    if (orbit_.in_contact) notes_.join_ends();
    double const eta = (displacement_ + derivative_ * error_) / (two_pi * orbit_.cycles);
    if (!std::isfinite(eta)) throw PhaseError("the efficiency is not a finite number");
    return {eta, notes_.mode(orbit_), orbit_.cycles, Outcome::periodic};
}

Efficiency ConveyorSolver::operator()(Conveyor const& conveyor, MotionStart const& start, Mean mean,
                                      std::vector<std::size_t> const* after_zero) {
    orbit_known_ = orbit_known_ && is_standard(start);
    from_ = start;
    mean_ = mean;
    after_zero_ = after_zero;
    try {
        return solve(conveyor);
    } catch (PhaseError const& error) {
        throw PhaseError(std::string(error.what()) + " (" + inputs_text(conveyor) + ")");
    }
}

ConveyorMotion ConveyorSolver::motion(Conveyor const& conveyor) {
    keep_ = true;
    Efficiency const found = (*this)(conveyor);
    keep_ = false;
    ConveyorMotion answer;
    answer.forces = std::make_shared<Forces const>(forces_);
    answer.motion = {.velocity_efficiency = found.velocity_efficiency,
                     .mode = "",
                     .phases = {},
                     .flight_number = 0,
                     .period_cycles = found.period_cycles,
                     .converged = found.outcome == Outcome::periodic,
                     .outcome = found.outcome};
    answer.half_width = found.half_width;
    if (found.outcome == Outcome::runs_away || found.outcome == Outcome::indifferent) return answer;
    if (!answer.motion.converged) answer.cycles_followed = static_cast<int>(std::lround(cycles_followed_));
    notes_.describe(forces_, orbit_, answer);
    return answer;
}

}  // namespace vibrotrough::theory::detail
