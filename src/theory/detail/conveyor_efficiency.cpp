#include "theory/detail/conveyor_efficiency.hpp"

#include "theory/detail/periodic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <boost/math/distributions/students_t.hpp>

namespace vibrotrough::theory::detail {
namespace {

// The last Newton step is added to first order. It is so small that it changes neither the mode nor the sum
// of the phases.
constexpr double velocity_tolerance = 1e-13;
constexpr double least_drift = 1e-9;  // per period, of a mass that runs away
constexpr double settled = 1e-11;     // change of the velocity from period to period
// Motions without a period. Batches become longer until the half-width is as wanted.
constexpr int settling = 100, shortest_batch = 16, longest_batch = 128;  // cycles
constexpr std::size_t batch_count = 20;
constexpr int flights_per_batch = 8;
constexpr double wanted_half_width = 0.01;
// One motion in ten without a period changes its manner over thousands of cycles, which batches do not show:
// with this factor the intervals held 95 % of 500 means over 200,000 cycles, and without it 92 %.
constexpr double slow_changes = 1.5;
constexpr std::size_t most_notes = 20000;  // kept of a motion without a period, beside its last batch
constexpr int most_periods = 3000;         // from rest
constexpr double all_but_one = 1 - 1e-9;   // share of mu up to which gravity is plainly weaker than friction

constexpr double repeat_match = 1e-9;  // of displacement and impact energy per cycle, period to period

bool is_standard(MotionStart const& start) {
    return start.at.t == 0 && start.rebound == 0 && start.v == 0;
}

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
    std::size_t hop = orbit_.first;
    auto const record = [&](PhaseKind kind, double from, double to, double speed, double moved,
                            double derivative) {
        displacement_ += moved;
        derivative_ += derivative;
        notes_.add(kind, hop, from, to, speed, moved);
    };
    ContactLaw const law(waves_);
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
Tangent ConveyorEfficiency::follow_from_start() {
    auto const ignore = [](PhaseKind, double, double, double, double, double) {};
    ContactLaw const law(waves_);
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
    FixedPoint const found = fixed_point(map, 0, velocity_tolerance);
    if (runs_away) return Search::runs_away;
    error_ = found.error;
    return slope_ < 1 ? Search::found : Search::failed;
}

/// With a larger static friction there can be several periodic motions. The map of the velocity is monotone:
/// from rest it goes to the nearest one.
ConveyorEfficiency::Search ConveyorEfficiency::iterate_from_start() {
    start_ = {0, 0, 1};
    double v = follow_from_start().v;
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
    return Search::failed;
}

/// Follows at least so many cycles of a motion without a period, from the start of hop number `hop`, and adds
/// hops where there are not enough. @return the mean slip velocity
double ConveyorEfficiency::follow_cycles(Tangent& s, std::size_t& hop, int cycles) {
    FlightChain const chain(waves_);
    ContactLaw const law(waves_);
    double elapsed = 0, moved = 0;
    auto const record = [&](PhaseKind kind, double from, double to, double speed, double distance, double) {
        moved += distance;
        if (keep_) notes_.add(kind, hop, from, to, speed, distance);
    };
    for (; elapsed < two_pi * cycles; ++hop) {
        if (hop == orbit_.hops.size()) {
            FlightChain::Start const start = with_rounding(orbit_.next, orbit_.hops.size());
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
    cycles_followed_ += elapsed / two_pi;
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
    return slow_changes * largest;
}

}  // namespace

/// Whether the next period, with rounding errors of its own, agrees with the one that was found last.
bool ConveyorEfficiency::repeats() const {
    double moved = 0, impacts = 0;  // energy of the impacts of this period minus that of the next
    auto const add = [&](PhaseKind, double, double, double, double distance, double) { moved += distance; };
    ContactLaw const law(waves_);
    Hints hints;
    Tangent s{v_, 1};
    for (Hop const& hop : orbit_.again) {
        s = follow_hop(law, hop, leap(waves_, hop), s, hints, add);
        impacts -= hop.approach * hop.approach;
    }
    for (std::size_t i = orbit_.first; i < orbit_.hops.size(); ++i)
        impacts += orbit_.hops[i].approach * orbit_.hops[i].approach;
    double const most = repeat_match * two_pi * orbit_.cycles;
    return !orbit_.again.empty() && std::abs(moved - displacement_) < most && std::abs(impacts) < most;
}

/// @param first  hop from which the cycles are followed; the leaps before it are known
std::optional<Efficiency> ConveyorEfficiency::average(std::size_t first) {
    if (mean_ == Mean::left_out) return Efficiency{0, 0, 0, Outcome::unsettled};
    orbit_.first = first;
    Tangent s = follow_from_start();
    std::size_t hop = first;
    longest_flight_ = 0;
    follow_cycles(s, hop, settling);
    batches_.clear();
    notes_.clear();
    double half_width = HUGE_VAL;
    cycles_followed_ = 0;
    for (int cycles = shortest_batch;; cycles *= 2) {
        while (batches_.size() < batch_count) {
            if (notes_.size() > most_notes) notes_.clear();
            batches_.push_back(follow_cycles(s, hop, cycles));
        }
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
    hints_ = {};  // those of another point would change the last bit
    if (!waves_.same_normal() || !orbit_known_) {
        orbit_known_ = false;
        find_normal_orbit(waves_, from_, orbit_, after_zero_);
        // Its first hop is another one when a mean was wanted; and a later point may have another start.
        orbit_known_ = is_standard(from_) && !orbit_.in_doubt;
        if (orbit_.joined != never) return Efficiency{0, 0, 0, Outcome::unsettled};
    }
    // Landings that hold exactly what gravity pulls leave any velocity as it is.
    double const pull = std::abs(waves_.gravity()), held = waves_.landing_tangent() * waves_.weight();
    if (!orbit_.in_contact && std::abs(pull - held) <= 1e-9 * pull) return std::nullopt;
    bool const has_period = orbit_.cycles > 0 && orbit_.cycles <= 64;
    bool const one_friction = waves_.one_friction();
    leaps_.resize(orbit_.hops.size());
    if (!has_period) {
        for (std::size_t i = 0; i < orbit_.first; ++i) leaps_[i] = leap(waves_, orbit_.hops[i]);
        return average(orbit_.first);
    }
    for (std::size_t i = one_friction ? orbit_.first : 0; i < orbit_.hops.size(); ++i)
        leaps_[i] = leap(waves_, orbit_.hops[i]);
    Search const search = one_friction ? find_fixed_point() : iterate_from_start();
    if (search == Search::found && orbit_.in_doubt && !repeats()) return average(0);
    if (search == Search::failed) return std::nullopt;
    if (search == Search::runs_away) {
        double const infinity = std::numeric_limits<double>::infinity();
        return Efficiency{std::copysign(infinity, -c.point.tan_inclination), 0, 0, Outcome::runs_away};
    }
    if (orbit_.in_contact) notes_.join_ends();
    double const eta = (displacement_ + derivative_ * error_) / (two_pi * orbit_.cycles);
    if (!std::isfinite(eta)) return std::nullopt;
    return Efficiency{eta, notes_.mode(orbit_), orbit_.cycles, Outcome::periodic};
}

std::optional<Efficiency> ConveyorEfficiency::operator()(Conveyor const& conveyor, MotionStart const& start,
                                                         Mean mean,
                                                         std::vector<std::size_t> const* after_zero) {
    if (!ordinary(conveyor)) return std::nullopt;
    orbit_known_ = orbit_known_ && is_standard(start);
    from_ = start;
    mean_ = mean;
    after_zero_ = after_zero;
    try {
        return solve(conveyor);
    } catch (PhaseError const&) {
        return std::nullopt;
    }
}

std::optional<ConveyorMotion> ConveyorEfficiency::motion(Conveyor const& conveyor) {
    keep_ = true;
    auto const found = (*this)(conveyor);
    keep_ = false;
    if (!found) return std::nullopt;
    ConveyorMotion answer;
    answer.motion = {.velocity_efficiency = found->velocity_efficiency,
                     .mode = "",
                     .phases = {},
                     .flight_number = 0,
                     .period_cycles = found->period_cycles,
                     .converged = found->outcome == Outcome::periodic,
                     .outcome = found->outcome};
    answer.half_width = found->half_width;
    if (found->outcome == Outcome::runs_away) return answer;
    if (!answer.motion.converged) answer.cycles_followed = static_cast<int>(std::lround(cycles_followed_));
    notes_.describe(waves_, orbit_, answer);
    return answer;
}

}  // namespace vibrotrough::theory::detail
