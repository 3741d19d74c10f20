#include "theory/detail/conveyor_efficiency.hpp"

#include "theory/detail/conveyor_period.hpp"
#include "theory/detail/periodic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <boost/math/distributions/students_t.hpp>

namespace vibrotrough::theory::detail {
namespace {

constexpr double shortest_phase = 1e-12;  // rad, as in solve()
// The last Newton step is added to first order instead of being evaluated again; the error is its square.
constexpr double velocity_tolerance = 1e-6;
constexpr double least_drift = 1e-9;  // per period, of a mass that runs away
constexpr double settled = 1e-11;     // change of the velocity from period to period
// Motions without a period. Batches become longer until the half-width is as wanted.
constexpr int settling = 100, shortest_batch = 16, longest_batch = 128;  // cycles
constexpr std::size_t batch_count = 20;
constexpr int flights_per_batch = 8;
constexpr double wanted_half_width = 0.01;
constexpr int most_periods = 3000;        // from rest
constexpr double all_but_one = 1 - 1e-9;  // share of mu up to which gravity is plainly weaker than friction

bool within(double x, double low, double high) {
    return x >= low && x <= high;
}

/// Whether nothing is so large, small or close to a limit that rounding needs the care of solve().
bool ordinary(Conveyor const& c) {
    double const b = c.point.tan_vibration_angle, a = std::abs(c.point.tan_inclination);
    EffectiveFriction const f = effective_friction(c);
    bool good = within(c.point.throw_number, 1e-3, 50) && within(b, 1e-4, 1e3) &&
                within(f.kinetic_friction * b, 1e-4, 100) && f.static_friction * b <= 100 &&
                f.landing_friction * b <= 100 && a * b <= 100 && c.restitution <= 0.95 &&
                c.slowest_rebound >= 1e-7 && (c.air_drag == 0 || within(c.air_drag, 1e-5, 10)) &&
                within(std::abs(c.along_ratio), 0, 100) && c.flight_start == FlightStart::actual_velocity;
    if (c.air_drag == 0) good = good && a < all_but_one * f.static_friction;
    if (c.air_drag == 0 && f.static_friction <= f.kinetic_friction)
        good = good && a < 0.999 * f.kinetic_friction;
    // Landings that hold exactly what gravity pulls leave any velocity as it is.
    good = good && std::abs(a - f.landing_friction) > 1e-9 * a;
    for (auto const* harmonics : {&c.along, &c.normal}) {
        for (Harmonic const& h : *harmonics) good = good && h.order <= 64 && std::abs(h.amplitude) <= 30;
    }
    return good;
}

}  // namespace

/// One period from velocity v at its start; notes the phases and adds up the displacement.
Tangent ConveyorEfficiency::follow_period(double v) {
    notes_.clear();
    displacement_ = derivative_ = 0;
    hints_.next = 0;
    auto const record = [this](PhaseKind kind, double from, double to, double moved, double derivative) {
        displacement_ += moved;
        derivative_ += derivative;
        if (to - from > shortest_phase) notes_.push_back({kind, from, to - from});
    };
    ContactLaw const law(waves_);
    Tangent s{v, 1};
    if (orbit_.in_contact) {
        Instant const end{start_.t + two_pi, start_.sine, start_.cosine};
        s = follow_contact(law, s, start_, end, false, hints_, record);
    } else {
        for (std::size_t i = orbit_.first; i < orbit_.hops.size(); ++i)
            s = follow_hop(law, orbit_.hops[i], leaps_[i], s, hints_, record);
    }
    v_ = v;
    slope_ = s.slope;
    return s;
}

/// From rest at t = 0 to the start of the period.
Tangent ConveyorEfficiency::follow_from_rest() {
    if (orbit_.in_contact) return {0, 0};
    auto const ignore = [](PhaseKind, double, double, double, double) {};
    ContactLaw const law(waves_);
    hints_ = {};
    Tangent s = follow_contact(law, {0, 0}, {0, 0, 1}, orbit_.hops.front().start, false, hints_, ignore);
    for (std::size_t i = 0; i < orbit_.first; ++i)
        s = follow_hop(law, orbit_.hops[i], leaps_[i], s, hints_, ignore);
    return s;
}

/// With one friction coefficient the map of the velocity never expands differences.
ConveyorEfficiency::Search ConveyorEfficiency::find_fixed_point() {
    if (orbit_.in_contact) {
        // The period starts where a slide begins, so that v = 0 is exact if there is a rest before it.
        Crossings const& forward = waves_.slide(1).starts();
        Crossings const& starts = forward.none() ? waves_.slide(-1).starts() : forward;
        start_ = {0, 0, 1};
        for (std::size_t i = 0; i < starts.count(); ++i) {
            if (!starts.rises(i)) continue;
            start_ = starts.zeros()[i];
            break;
        }
    }
    double const fast = 1e4 * (1 + std::abs(waves_.vx().sine) + std::abs(waves_.vx().cosine));
    bool runs_away = false;
    auto const map = [&](double v) {
        Tangent const after = follow_period(v);
        double const drift = after.v - v;
        bool const faster = after.slope == 1 && std::abs(v) > fast && drift * v > 0;
        if (!faster || std::abs(drift) < least_drift * std::abs(v) / fast) return after;
        runs_away = true;
        return Tangent{v, 0};
    };
    double const guess = guess_in_contact_ == orbit_.in_contact ? guess_ : 0;
    FixedPoint found = fixed_point(map, guess, velocity_tolerance);
    if (runs_away) return Search::runs_away;
    if (orbit_.in_contact && found.v != 0 && std::abs(found.v + found.error) <= velocity_tolerance)
        found = fixed_point(map, 0, velocity_tolerance);
    error_ = found.error;
    guess_ = found.v + found.error;
    guess_in_contact_ = orbit_.in_contact;
    return slope_ < 1 ? Search::found : Search::failed;
}

/// With a larger static friction there can be several periodic motions. The map of the velocity is monotone:
/// from rest it goes to the nearest one.
ConveyorEfficiency::Search ConveyorEfficiency::iterate_from_rest() {
    start_ = {0, 0, 1};
    double v = follow_from_rest().v;
    ModeCode before = 0;
    double stride = 1, last = v, last_drift = 0;
    for (int i = 0; i < most_periods; ++i) {
        Tangent after = follow_period(v);
        double const drift = after.v - v;
        error_ = 0;
        if (std::abs(drift) <= settled * (1 + std::abs(v))) {
            if (slope_ == 1) return Search::failed;
            error_ = drift / (1 - slope_);
            return Search::found;
        }
        // Where nothing stops the mass, the drift is the same at any speed. A stride beyond that is taken
        // back.
        bool const plain =
            slope_ == 1 && (stride == 1 || std::abs(drift - last_drift) <= 1e-9 * (1 + std::abs(v)));
        if (plain) {
            bool const downhill = std::abs(waves_.gravity()) > waves_.kinetic_tangent() * waves_.weight();
            if (downhill && std::abs(v) > 10 && drift * v > 0) return Search::runs_away;
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
        ModeCode const now = mode();
        bool const same = now == before;
        before = now;
        double const newton = v + drift / (1 - slope_);
        if (same && slope_ > 0) {
            Tangent const there = follow_period(newton);
            if (mode() == now && std::abs(there.v - newton) < std::abs(drift) / 2) {
                v = newton;
                continue;
            }
        }
        v = after.v;
    }
    return Search::failed;
}

/// Without flights the period may start within a phase.
void ConveyorEfficiency::join_ends() {
    if (!orbit_.in_contact || notes_.size() < 2 || notes_.front().kind != notes_.back().kind) return;
    notes_.front().start = notes_.back().start;
    notes_.front().duration += notes_.back().duration;
    notes_.pop_back();
}

/// The phase with which the list of phases starts: a take-off from contact, otherwise any flight, otherwise
/// the positive slide, otherwise the negative slide, otherwise the first phase.
std::size_t ConveyorEfficiency::first_phase() const {
    std::size_t const n = notes_.size();
    auto const find = [&](auto const& wanted) {
        std::size_t best = n;
        double earliest = HUGE_VAL;
        for (std::size_t i = 0; i < n; ++i) {
            if (!wanted(notes_[i], notes_[(i + n - 1) % n])) continue;
            double phase = notes_[i].start - two_pi * std::floor(notes_[i].start * (1 / two_pi));
            if (phase <= 0) phase = two_pi;
            if (orbit_.cycles == 1 ? phase < earliest : best == n) {
                best = i;
                earliest = phase;
            }
        }
        return best;
    };
    std::size_t i = find([](Note const& now, Note const& before) {
        return now.kind == PhaseKind::flight && before.kind != PhaseKind::flight;
    });
    for (auto const kind : {PhaseKind::flight, PhaseKind::positive_slide, PhaseKind::negative_slide}) {
        if (i == n) i = find([kind](Note const& now, Note const&) { return now.kind == kind; });
    }
    return i < n ? i : 0;
}

ModeCode ConveyorEfficiency::mode() const {
    ModeCode code = 0;
    std::size_t const n = notes_.size(), first = first_phase();
    for (std::size_t i = 0; i < n; ++i)
        code = append_phase(code, notes_[(first + i) % n].kind, static_cast<int>(i));
    return code;
}

/// Follows at least so many cycles of a motion without a period, from the start of hop number `hop`, and adds
/// hops where there are not enough. @return the mean slip velocity
double ConveyorEfficiency::follow_cycles(Tangent& s, std::size_t& hop, int cycles) {
    FlightChain const chain(waves_);
    ContactLaw const law(waves_);
    double elapsed = 0, moved = 0;
    auto const record = [&](PhaseKind, double, double, double distance, double) { moved += distance; };
    for (; elapsed < two_pi * cycles; ++hop) {
        if (hop == orbit_.hops.size()) {
            FlightChain::Start const start = orbit_.next;
            orbit_.hops.push_back(chain.fly(start, orbit_.next));
        }
        Hop const& now = orbit_.hops[hop];
        hints_.next = 0;
        s = follow_hop(law, now, leap(waves_, now), s, hints_, record);
        elapsed += now.leave.t - now.start.t;
        longest_flight_ = std::max(longest_flight_, now.end.t - now.start.t);
        if (longest_flight_ * flights_per_batch > two_pi * longest_batch)
            throw PhaseError("flights are too long");
    }
    return moved / elapsed;
}

namespace {

double mean_of(std::vector<double> const& values) {
    double sum = 0;
    for (double const one : values) sum += one;
    return sum / static_cast<double>(values.size());
}

/// Two batches after each other become one.
void join_pairs(std::vector<double>& batches) {
    for (std::size_t i = 0; i < batches.size() / 2; ++i)
        batches[i] = (batches[2 * i] + batches[2 * i + 1]) / 2;
    batches.resize(batches.size() / 2);
}

/// Half the 95 % confidence interval of the mean of 20 batches (Student's t): the largest of those of 20, 10
/// and 5 batches. Where it grows with the length of the batches, they are too short: their means are not
/// independent. The copy is small.
double half_width_of(std::vector<double> batches) {
    static std::array<double, batch_count + 1> const student = [] {
        std::array<double, batch_count + 1> quantiles{};
        for (std::size_t n = batch_count; n >= batch_count / 4; n /= 2)
            quantiles[n] = boost::math::quantile(boost::math::students_t(static_cast<double>(n - 1)), 0.975);
        return quantiles;
    }();
    double largest = 0, mean = mean_of(batches);
    for (; batches.size() >= batch_count / 4; join_pairs(batches)) {
        auto const n = static_cast<double>(batches.size());
        double squares = 0;
        for (double const one : batches) squares += (one - mean) * (one - mean);
        largest = std::max(largest, student[batches.size()] * std::sqrt(squares / (n - 1) / n));
    }
    return largest;
}

}  // namespace

std::optional<Efficiency> ConveyorEfficiency::average() {
    Tangent s = follow_from_rest();
    std::size_t hop = orbit_.first;
    longest_flight_ = 0;
    follow_cycles(s, hop, settling);
    batches_.clear();
    double half_width = HUGE_VAL;
    for (int cycles = shortest_batch;; cycles *= 2) {
        while (batches_.size() < batch_count) batches_.push_back(follow_cycles(s, hop, cycles));
        half_width = half_width_of(batches_);
        bool const has_flights = longest_flight_ * flights_per_batch <= two_pi * cycles;
        if (cycles == longest_batch || (has_flights && half_width <= wanted_half_width)) break;
        join_pairs(batches_);
    }
    double const fast = 10 * (1 + std::abs(waves_.vx().sine) + std::abs(waves_.vx().cosine));
    if (!(std::abs(s.v) < fast)) return std::nullopt;  // it may run away
    return Efficiency{mean_of(batches_), 0, 0, Outcome::unsettled, half_width};
}

std::optional<Efficiency> ConveyorEfficiency::solve(Conveyor const& c) {
    waves_.set(c);
    if (!waves_.same_normal() || !orbit_known_) {
        orbit_known_ = false;
        find_normal_orbit(waves_, orbit_);
        orbit_known_ = true;
    }
    if (orbit_.in_doubt) {
        // solve() decides whether the period counts, but need not follow its 3000 cycles for a mean.
        auto const known = motion_with_period(c);
        if (!known) return average();
        Motion const& motion = known->motion;
        return Efficiency{motion.velocity_efficiency, mode_code(motion), motion.period_cycles,
                          motion.outcome};
    }
    bool const has_period = orbit_.cycles > 0 && orbit_.cycles <= 64;
    bool const one_friction = waves_.one_friction();
    leaps_.resize(orbit_.hops.size());
    if (!has_period) {
        for (std::size_t i = 0; i < orbit_.first; ++i) leaps_[i] = leap(waves_, orbit_.hops[i]);
        return average();
    }
    for (std::size_t i = one_friction ? orbit_.first : 0; i < orbit_.hops.size(); ++i)
        leaps_[i] = leap(waves_, orbit_.hops[i]);
    Search const search = one_friction ? find_fixed_point() : iterate_from_rest();
    if (search == Search::failed) return std::nullopt;
    if (search == Search::runs_away) {
        double const infinity = std::numeric_limits<double>::infinity();
        return Efficiency{std::copysign(infinity, -c.point.tan_inclination), 0, 0, Outcome::runs_away};
    }
    join_ends();
    double const eta = (displacement_ + derivative_ * error_) / (two_pi * orbit_.cycles);
    if (!std::isfinite(eta)) return std::nullopt;
    return Efficiency{eta, mode(), orbit_.cycles, Outcome::periodic};
}

std::optional<Efficiency> ConveyorEfficiency::operator()(Conveyor const& conveyor) {
    if (!ordinary(conveyor)) return std::nullopt;
    try {
        return solve(conveyor);
    } catch (PhaseError const&) {
        return std::nullopt;
    }
}

}  // namespace vibrotrough::theory::detail
