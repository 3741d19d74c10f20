#include "walked_motion.hpp"

#include "conveyor_walk.hpp"
#include "theory/detail/fixed_point.hpp"
#include "theory/detail/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <boost/math/distributions/students_t.hpp>

namespace vibrotrough::theory {
namespace {

using detail::two_pi;
using Keep = Walk::Keep;

constexpr int longest_period = 64;     // cycles
constexpr int settling = 500;          // cycles skipped before averaging a motion without a period
constexpr int batches = 20;            // number of batch means for its confidence interval
constexpr int cycles_per_batch = 125;  // or more, so that a batch has some flights
constexpr int most_cycles_per_batch = 1000000;
constexpr int flights_per_batch = 8;
constexpr std::size_t most_pieces = 20000;  // kept of a motion without a period, beside its last batch
// Ends of phases that are looked at before a motion counts as one without a period, and in one of its
// batches: for harmonics of high order, in the cycles of others there are too many of them (a million take
// half a second).
constexpr int most_events = 1000000, most_events_per_batch = 25000;
constexpr int plain_repeats = 60;  // periods followed directly before Newton's method takes over
constexpr double least_drift =
    1e-9;  // of the velocity per period, beyond rounding at the speed at which it is looked at
constexpr double closing = 1e-6;  // rad: tolerance in time for an orbit that recurs within state_match
constexpr double repeat_match =
    1e-9;  // tolerance of displacement and impact energy per cycle, period to period
constexpr double state_match = 1e-13;  // tolerance of gap, its rate and slip velocity, in their units

Motion no_motion(Outcome outcome, double eta) {
    return {.velocity_efficiency = eta,
            .mode = "",
            .phases = {},
            .flight_number = 0,
            .period_cycles = 0,
            .converged = false,
            .outcome = outcome};
}

WalkState at_rest(WalkModel const& model) {
    WalkState s;
    s.flying = model.normal_force(0) < 0;
    return s;
}

double normal_mismatch(WalkState const& a, WalkState const& b) {
    if (a.flying != b.flying) return HUGE_VAL;
    return std::max(std::abs(a.gap - b.gap), std::abs(a.gap_rate - b.gap_rate));
}

double mismatch(WalkState const& a, WalkState const& b) {
    return std::max(normal_mismatch(a, b), std::abs(a.v - b.v));
}

/// The number of steps after which the state recurs, found by comparison with the earlier `starts` (the last
/// of which is one step old); 0 when it does not recur.
template <class Mismatch>
int steps_to_return(WalkState const& now, std::vector<WalkState> const& starts, int most,
                    Mismatch const& differ) {
    auto const off = [&](int n) { return differ(now, starts[starts.size() - static_cast<std::size_t>(n)]); };
    for (int n = 1; n <= std::min(most, static_cast<int>(starts.size())); ++n) {
        if (!(off(n) < state_match)) continue;
        for (int shorter = 1; shorter < n;
             ++shorter) {  // an alternating approach meets the tolerance for 2 steps before it does for 1
            if (n % shorter == 0 && off(shorter) < 1e3 * state_match) return shorter;
        }
        return n;
    }
    return 0;
}

class Solver {
  public:
    explicit Solver(Conveyor const& conveyor)
        : model_(std::make_shared<WalkModel const>(conveyor)), walk_(*model_), state_(at_rest(*model_)) {}

    /// The motion; nothing when it has no period.
    std::optional<ConveyorMotion> with_period();
    /// The mean of a motion without a period, after with_period().
    ConveyorMotion averaged();

  private:
    bool gravity_wins() const;
    int find_normal_period();
    int settle_along(int cycles);
    Passage pass(WalkState& s, int cycles, Keep keep) const {
        Passage passage;
        walk_.advance(s, s.t + two_pi * cycles, passage, keep);
        return passage;
    }
    void rebase() { state_.t -= two_pi * std::round(state_.t / two_pi); }
    bool repeats(Passage const& two_periods, int cycles) const;
    std::optional<ConveyorMotion> periodic(int cycles);
    ConveyorMotion runaway() const;
    ConveyorMotion average(int cycles);
    void add_batch(ConveyorMotion& result, Passage&& passage, int cycles_before) const;

    std::shared_ptr<WalkModel const> model_;
    Walk walk_;
    WalkState state_;
    bool runs_away_ = false;
};

bool Solver::gravity_wins() const {
    auto const friction = effective_friction(model_->conveyor());
    return model_->drag() == 0 &&
           std::abs(model_->conveyor().point.tan_inclination) > friction.static_friction;
}

/// The number of cycles after which the normal motion recurs; 0 when it does not. Leaves `state_` there.
int Solver::find_normal_period() {
    std::vector<WalkState> starts;
    int events = 0;
    for (int cycle = 0; cycle < settling + batches * cycles_per_batch && events < most_events; ++cycle) {
        starts.push_back(state_);
        events += pass(state_, 1, Keep::nothing).events;
        rebase();
        int const n = steps_to_return(state_, starts, longest_period, normal_mismatch);
        if (n > 0) return n;
    }
    return 0;
}

/// Makes the motion along the trough periodic when the normal motion already is. @return its period in
/// cycles, 0 if none was found
int Solver::settle_along(int cycles) {
    bool const one_friction = model_->conveyor().static_friction <= model_->conveyor().point.friction;
    bool const by_rule = model_->conveyor().flight_start != FlightStart::actual_velocity;
    std::vector<WalkState> starts;
    int const repeats = one_friction && !by_rule ? plain_repeats : 3000;
    for (int i = 0; i < repeats; ++i) {
        starts.push_back(state_);
        state_.slope = 1;
        Passage const passage = pass(state_, cycles, Keep::nothing);
        rebase();
        double const drift = state_.v - starts.back().v;
        if (!passage.stopped && state_.slope == 1 && std::abs(drift) > 0 && std::abs(state_.v) > 10 &&
            drift * state_.v > 0 &&
            std::abs(model_->gravity()) > model_->kinetic_tangent() * model_->weight()) {
            runs_away_ = true;
            return 0;
        }
        int const n = steps_to_return(state_, starts, longest_period / cycles, mismatch);
        if (n > 0) return n * cycles;
    }
    if (repeats > plain_repeats) return 0;
    WalkState const start = state_;
    auto const map = [&](double v) {
        WalkState s = start;
        s.v = v;
        s.slope = 1;
        s.starting = 0;
        pass(s, cycles, Keep::nothing);
        return detail::Tangent{s.v, s.slope};
    };
    // The drift per period never increases with v. Where the mass is so fast that it never stops, it is the
    // same at any speed, and where gravity wins there, it wins everywhere: landings may have less friction
    // than slides.
    double const fast = 1e4 * (1 + model_->trough_vx_bound());
    if (map(fast).v - fast > least_drift || map(-fast).v + fast < -least_drift) {
        runs_away_ = true;
        return 0;
    }
    state_.v = detail::fixed_point(map, start.v, 1e-14).v;
    state_.starting = 0;
    return cycles;
}

/// The piece with which the list of phases starts: a take-off from contact, otherwise any flight, otherwise
/// the positive slide, otherwise the negative slide, otherwise the first piece.
std::size_t first_piece(std::vector<Piece> const& pieces) {
    auto const find = [&](auto const& wanted) {
        for (std::size_t i = 1; i < pieces.size(); ++i) {
            if (wanted(pieces[i], pieces[i - 1])) return i;
        }
        return std::size_t{0};
    };
    auto const is = [](PhaseKind kind) {
        return [kind](Piece const& p, Piece const&) { return p.kind == kind; };
    };
    auto const takes_off = [](Piece const& p, Piece const& before) {
        return p.kind == PhaseKind::flight && before.kind != PhaseKind::flight;
    };
    std::size_t i = find(takes_off);
    for (auto const kind : {PhaseKind::flight, PhaseKind::positive_slide, PhaseKind::negative_slide}) {
        if (i == 0) i = find(is(kind));
    }
    return i;
}

/// Rebounds can amplify rounding errors from one period to the next until the two differ. The motion is then
/// not accepted as periodic.
bool Solver::repeats(Passage const& two_periods, int cycles) const {
    WalkState s = state_;
    double const length = two_pi * cycles, once = pass(s, cycles, Keep::nothing).displacement;
    double impacts = 0;  // energy of the impacts of the first period minus that of the second
    for (Impact const& impact : two_periods.impacts) {
        double const energy = impact.approach * impact.approach;
        impacts += impact.t < state_.t + length ? energy : -energy;
    }
    return std::abs(two_periods.displacement - 2 * once) < repeat_match * length &&
           std::abs(impacts) < repeat_match * length;
}

std::optional<ConveyorMotion> Solver::periodic(int cycles) {
    // Follow two periods; the list of phases starts at an event within the first.
    WalkState s = state_;
    Passage scout = pass(s, 2 * cycles, Keep::pieces);
    if (!repeats(scout, cycles)) return std::nullopt;
    std::size_t const first = first_piece(scout.pieces);
    double const start = scout.pieces[first].start, length = two_pi * cycles;
    ConveyorMotion result;
    Motion& motion = result.motion;
    motion = no_motion(Outcome::periodic, 0);
    double displacement = 0, last_end = start;
    double const shift = two_pi * std::floor(start / two_pi);
    for (std::size_t i = first; i < scout.pieces.size(); ++i) {
        Piece piece = scout.pieces[i];
        if (piece.start > start + length - closing) break;
        last_end = piece.end;
        if (piece.end > start + length + closing) piece.displacement /= 2;  // one slide lasts both periods
        piece.end = std::min(piece.end, start + length);
        result.pieces.push_back(piece);
        displacement += piece.displacement;
        motion.phases.push_back({piece.kind, piece.start - shift, piece.end - shift, piece.displacement});
        motion.mode += to_string(piece.kind);
        if (piece.kind == PhaseKind::flight) {
            motion.flight_number = std::max(motion.flight_number, (piece.end - piece.start) / two_pi);
        }
    }
    for (Impact const& impact : scout.impacts) {
        if (impact.t > start + closing && impact.t <= last_end) result.impacts.push_back(impact);
    }
    motion.velocity_efficiency = displacement / length;
    motion.period_cycles = cycles;
    motion.converged = true;
    return result;
}

/// rad, the longest flight. A piece that continues a flight begins with a gap.
double longest_flight(std::vector<Piece> const& pieces) {
    double longest = 0, start = 0;
    for (Piece const& piece : pieces) {
        if (piece.kind != PhaseKind::flight) continue;
        if (piece.gap == 0 || &piece == &pieces.front()) start = piece.start;
        longest = std::max(longest, piece.end - start);
    }
    return longest;
}

/// Adds what happened in a batch that begins so many cycles after the first one. When there is too much, what
/// was there before is forgotten.
void Solver::add_batch(ConveyorMotion& result, Passage&& passage, int cycles_before) const {
    if (result.pieces.size() > most_pieces) {
        result.pieces.clear();
        result.impacts.clear();
    }
    double const shift = two_pi * cycles_before;
    for (Piece& piece : passage.pieces) {
        piece.start += shift;
        piece.end += shift;
        result.pieces.push_back(piece);
    }
    for (Impact& impact : passage.impacts) {
        impact.t += shift;
        result.impacts.push_back(impact);
    }
}

/// The mean over batches of so many cycles, and what happened in them.
ConveyorMotion Solver::average(int cycles) {
    ConveyorMotion result;
    std::vector<double> means;
    bool stopped = model_->drag() > 0;
    double const length = two_pi * cycles;
    for (int i = 0; i < batches; ++i) {
        Passage passage = pass(state_, cycles, Keep::pieces);
        means.push_back(passage.displacement / length);
        stopped = stopped || passage.stopped;
        add_batch(result, std::move(passage), i * cycles);
        rebase();
    }
    // The mass is faster from batch to batch and never stops. (20 means are in order by chance once in 1e18
    // times.)
    double const downhill = -std::copysign(1.0, model_->gravity());
    bool const fast = downhill * state_.v > 10 * (1 + model_->trough_vx_bound());
    auto const is_slower = [&](double p, double q) { return downhill * p < downhill * q; };
    runs_away_ = fast && !stopped && std::is_sorted(means.begin(), means.end(), is_slower);
    double mean = 0, square = 0;
    for (double const m : means) mean += m / batches;
    for (double const m : means) square += (m - mean) * (m - mean) / (batches - 1);
    boost::math::students_t const student(batches - 1);
    result.half_width = boost::math::quantile(student, 0.975) * std::sqrt(square / batches);
    result.cycles_followed = batches * cycles;
    result.motion = no_motion(Outcome::unsettled, mean);
    return result;
}

/// A flight can last thousands of cycles, and the mean over a part of one says nothing of the motion: the
/// batches become longer until there is room for some flights in each.
ConveyorMotion Solver::averaged() {
    WalkState begin = state_;
    int const events = pass(begin, 1, Keep::nothing).events;
    int cycles = std::clamp(most_events_per_batch / std::max(events, 1), 1, cycles_per_batch);
    while (true) {
        pass(state_, settling * cycles / cycles_per_batch, Keep::nothing);
        rebase();
        ConveyorMotion result = average(cycles);
        if (longest_flight(result.pieces) * flights_per_batch <= two_pi * cycles ||
            cycles >= most_cycles_per_batch)
            return runs_away_ ? runaway() : result;
        cycles *= 4;
    }
}

ConveyorMotion Solver::runaway() const {
    double const infinity = std::numeric_limits<double>::infinity();
    ConveyorMotion result;
    result.motion =
        no_motion(Outcome::runs_away, std::copysign(infinity, -model_->conveyor().point.tan_inclination));
    return result;
}

std::optional<ConveyorMotion> Solver::with_period() {
    if (gravity_wins()) return runaway();
    if (std::max(model_->kinetic_tangent(), model_->landing_tangent()) == 0 &&
        model_->conveyor().point.tan_inclination == 0 && model_->drag() == 0) {
        ConveyorMotion result;
        result.motion = no_motion(Outcome::indifferent, 0);
        return result;
    }
    int const normal = find_normal_period();
    int const cycles = normal > 0 ? settle_along(normal) : 0;
    if (runs_away_) return runaway();
    if (cycles == 0) return std::nullopt;
    return periodic(cycles);
}

}  // namespace

ConveyorMotion walked_motion(Conveyor const& conveyor) {
    try {
        Solver solver(conveyor);
        auto known = solver.with_period();
        return known ? std::move(*known) : solver.averaged();
    } catch (PhaseError const& error) {
        throw PhaseError(std::string(error.what()) + " (" + detail::inputs_text(conveyor) + ")");
    }
}

}  // namespace vibrotrough::theory
