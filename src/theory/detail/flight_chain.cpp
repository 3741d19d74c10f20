#include "theory/detail/flight_chain.hpp"

#include <algorithm>
#include <cstdint>

namespace vibrotrough::theory::detail {
namespace {

constexpr int most_sections = 2000;    // of one flight
constexpr double series_range = 0.01;  // rad of the highest order, for flights that a series describes
constexpr double state_match = 1e-11;  // of phase and rate, from period to period
constexpr int longest_period = 64, most_cycles = 3000;
// A motion is chaotic if small changes grow by this factor between these cycles.
constexpr double chaotic_growth = 1e10;
constexpr int chaos_from = 500, chaos_to = 1000;
// A period within which small changes grow by the first factor is in doubt, because rounding errors grow as
// well. From the second factor on there is none.
constexpr double most_growth = 1e6, hopeless_growth = 1e11, rounding = 1e-16;
constexpr std::size_t never = static_cast<std::size_t>(-1);

/// Sine and cosine a step later, exact to rounding for |d| <= 0.01.
Instant series_shifted(Instant const& a, double d) {
    double const q = d * d, sine = d * (1 - q / 6 * (1 - q / 20)), less = q / 2 * (1 - q / 12 * (1 - q / 30));
    return {a.t + d, a.sine + (a.cosine * sine - a.sine * less),
            a.cosine - (a.sine * sine + a.cosine * less)};
}

}  // namespace

/// The gap above the trough after a take-off: g'' + kappa g' = -N.
struct FlightChain::Ballistic {
    ConveyorWaves const& waves;
    Instant start;
    double speed, level;  // absolute, at the start

    Ballistic(ConveyorWaves const& w, Start const& s)
        : waves(w), start(s.at), speed(w.vy()(s.at) + s.rate), level(w.y()(s.at)) {}

    double gap(Instant const& at, Decayed const& d) const {
        return speed * d.once - waves.weight() * d.twice - (waves.y()(at) - level);
    }
    double rate(Instant const& at, Decayed const& d) const {
        return speed * d.decay - waves.weight() * d.once - waves.vy()(at);
    }
    Decayed decayed(double t) const { return Decayed::after(waves.drag(), t - start.t); }
};

FlightChain::Start FlightChain::from_contact(Instant const& at) const {
    auto section = waves_.presses().at(at.t);
    if (!section.positive) return {at, 0, -1};  // the trough falls away at once
    return {section.end, 0, static_cast<int>(section.next)};
}

FlightChain::Start FlightChain::first() const {
    return from_contact({0, 0, 1});
}

Hop FlightChain::fly(Start const& start, Start& next) const {
    Hop hop = flight(start);
    double const bounce = waves_.restitution() * hop.approach;
    hop.rebound = bounce > waves_.slowest_rebound() ? bounce : 0;
    next = hop.rebound > 0 ? Start{hop.end, hop.rebound, -1} : from_contact(hop.end);
    hop.leave = next.at;
    next.at.t -= two_pi * std::floor(next.at.t * (1 / two_pi));
    return hop;
}

/// A flight so short that the gap is a polynomial: no sine is needed, and no digits are lost.
bool FlightChain::short_flight(Start const& start, Hop& hop) const {
    if (!(start.rate > 0)) return false;
    Wave const& normal = waves_.normal_force();
    double const force = normal(start.at);
    double h = 2 * start.rate / force;
    double const range = series_range / normal.highest_order();
    if (!(force > 0 && h < range)) return false;
    double const k = waves_.drag();
    double const g2 = -force - k * start.rate, g3 = -normal.rate(start.at) - k * g2;
    double const g4 = -normal.bend(start.at) - k * g3;
    // The next derivatives: those of the fundamental dominate, and the rest is below rounding in this range.
    double const g5 = normal.rate(start.at) - k * g4, g6 = normal.bend(start.at) - k * g5;
    if (!normal.overtones.empty() || k > 1) {
        if (h > range / 10) return false;
    }
    for (int i = 0; i < 20; ++i) {
        double const over =
            start.rate + h * (g2 / 2 + h * (g3 / 6 + h * (g4 / 24 + h * (g5 / 120 + h * g6 / 720))));
        double const slope = g2 / 2 + h * (g3 / 3 + h * (g4 / 8 + h * (g5 / 30 + h * g6 / 144)));
        if (!(slope < 0)) return false;
        double const step = -over / slope;
        h += step;
        if (!(h > 0 && h < range)) return false;
        if (std::abs(step) <= 1e-9 * h) break;  // the next step would be its square
        if (i == 19) return false;
    }
    double const rate = start.rate + h * (g2 + h * (g3 / 2 + h * (g4 / 6 + h * (g5 / 24 + h * g6 / 120))));
    hop = {start.at, series_shifted(start.at, h), {}, std::max(-rate, 0.0), 0, Decayed::after(k, h)};
    return true;
}

/// The gap falls from a positive to a zero or negative value between low and high and has one zero there:
/// Halley's method within the bracket.
Hop FlightChain::landing(Start const& start, Ballistic const& path, double low, double high) const {
    Wave const& normal = waves_.normal_force();
    double t = high;
    if (start.rate > 0) {
        double const guess = start.at.t + 2 * start.rate / normal(start.at);
        if (guess > low && guess < high) t = guess;
    }
    for (int i = 0; i < 200; ++i) {
        Instant const here = Instant::at(t);
        Decayed const d = path.decayed(t);
        double const gap = path.gap(here, d), rate = path.rate(here, d);
        double const bend = -(normal(here) + waves_.drag() * rate) / rate;
        double const newton = -gap / rate, step = newton / (1 + newton * bend / 2);
        (gap > 0 ? low : high) = t;
        double next = t + step;
        // Beside the lowest gap, where the rate is zero, Halley's step is short and leads nowhere.
        bool const inside = rate < 0 && std::abs(newton * bend) < 1 && next >= low && next <= high;
        if (inside && std::abs(step) * std::max(1.0, std::abs(bend)) < root_step) {
            Instant const end = shifted(here, step);
            Decayed const to_end = path.decayed(end.t);
            return {start.at, end, {}, std::max(-path.rate(end, to_end), 0.0), 0, to_end};
        }
        if (!inside || i > 20) next = low + (high - low) / 2;
        if (high - low <= 4e-16 * (1 + t) || next == t)
            return {start.at, here, {}, std::max(-rate, 0.0), 0, d};
        t = next;
    }
    throw PhaseError("the landing was not found");
}

/// The time of the lowest gap: the zero of its rate, which rises from negative to positive.
double FlightChain::lowest(Ballistic const& path, double low, double high) const {
    double t = low + (high - low) / 2;
    for (int i = 0; i < 200; ++i) {
        Instant const here = Instant::at(t);
        double const rate = path.rate(here, path.decayed(t));
        (rate > 0 ? high : low) = t;
        double next = t + rate / (waves_.normal_force()(here) + waves_.drag() * rate);
        if (!(next > low && next < high)) next = low + (high - low) / 2;
        if (std::abs(next - t) <= 4e-16 * (1 + t)) break;
        t = next;
    }
    return t;
}

// Between the zeros of the normal force N, g' exp(kappa t) is monotone, so that g' has one zero at most.
Hop FlightChain::flight(Start const& start) const {
    Hop hop{};
    bool found = short_flight(start, hop);
    if (!found) {
        Ballistic const path(waves_, start);
        auto section = waves_.presses().at(start.at.t);
        if (start.rate == 0 && section.positive) throw PhaseError("a flight starts in contact");
        double from = start.at.t, gap = 0, rate = start.rate;
        for (int i = 0; !found; ++i) {
            if (i > most_sections || !std::isfinite(section.end.t))
                throw PhaseError("the flight does not end");
            double to = section.end.t;
            Decayed const d = path.decayed(to);
            double const end_gap = path.gap(section.end, d), end_rate = path.rate(section.end, d);
            if (section.positive) {
                found = end_rate < 0 && end_gap <= 0;
            } else if (rate < 0) {
                found = end_gap <= 0;
                if (!found && end_rate > 0 && gap + rate * (to - from) <= 0) {
                    to = lowest(path, from, to);
                    found = path.gap(Instant::at(to), path.decayed(to)) <= 0;
                }
            }
            if (found) {
                hop = landing(start, path, from, to);
            } else {
                from = section.end.t;
                gap = end_gap;
                rate = end_rate;
                waves_.presses().advance(section);
            }
        }
    }
    return hop;
}

Sensitivity Sensitivity::after(Sensitivity const& e) const {
    return {phase_phase * e.phase_phase + phase_rate * e.rate_phase,
            phase_phase * e.phase_rate + phase_rate * e.rate_rate,
            rate_phase * e.phase_phase + rate_rate * e.rate_phase,
            rate_phase * e.phase_rate + rate_rate * e.rate_rate};
}

double Sensitivity::size() const {
    return std::max(std::abs(phase_phase) + std::abs(phase_rate), std::abs(rate_phase) + std::abs(rate_rate));
}

// A later start by d lowers the gap by (rate d) and raises its rate by (N + kappa rate) d at the start, and
// the landing is where the gap is zero again.
Sensitivity FlightChain::sensitivity(Hop const& hop, double start_rate) const {
    double const kappa = waves_.drag(), approach = std::max(hop.approach, 1e-12);
    Decayed const& d = hop.decayed;
    double const push = waves_.normal_force()(hop.start) + kappa * start_rate;
    double const slowing = waves_.normal_force()(hop.end) - kappa * hop.approach;
    double const phase_phase = (d.once * push - start_rate) / approach, phase_rate = d.once / approach;
    double const e = hop.rebound > 0 ? waves_.restitution() : 0;
    return {phase_phase, phase_rate, e * (slowing * phase_phase - d.decay * push),
            e * (slowing * phase_rate - d.decay)};
}

namespace {

/// The difference of the states at two landings; multiples of a cycle do not count.
double difference(Hop const& a, Hop const& b) {
    double const turns = (a.end.t - b.end.t) * (1 / two_pi);
    return std::max(std::abs(a.rebound - b.rebound), two_pi * std::abs(turns - std::round(turns)));
}

double duration(Hop const& hop) {
    return hop.leave.t - hop.start.t;
}

constexpr double longest_return = two_pi * (longest_period + 0.5);

/// The number of hops after which the phase of the landing and the rebound repeat; 0 when they do not.
/// @param since  the first hop after the last contact
std::size_t hops_to_return(std::vector<Hop> const& hops, std::size_t since) {
    Hop const& now = hops.back();
    double elapsed = 0;
    for (std::size_t k = 1; k + since < hops.size() && elapsed < longest_return; ++k) {
        Hop const& earlier = hops[hops.size() - 1 - k];
        elapsed += duration(earlier);
        if (!(std::abs(now.rebound - earlier.rebound) < state_match)) continue;
        if (!(difference(now, earlier) < state_match)) continue;
        for (std::size_t shorter = 1; shorter < k; ++shorter) {
            // An alternating approach meets the tolerance for 2 before it does for 1.
            if (k % shorter == 0 && difference(now, hops[hops.size() - 1 - shorter]) < 1e3 * state_match)
                return shorter;
        }
        return k;
    }
    return 0;
}

/// Whether a rebound is that of an earlier hop, as in nearly no hop of a motion without a period: only then
/// is hops_to_return() worth its cost. The rebounds lie side by side, so that the compiler compares several
/// at once. Where they are many, a bit for each 1e-9 (by its remainder) says that most have no equal.
class Rebounds {
  public:
    /// @param memory, seen  for the rebounds of all hops
    Rebounds(std::vector<double>& memory, std::vector<bool>& seen) : all_(memory), seen_(seen) {
        all_.clear();
    }

    /// Adds the last of the hops. @param since  the first hop after the last contact
    bool repeat(std::vector<Hop> const& hops, std::size_t since) {
        double const now = hops.back().rebound;
        std::size_t const count = all_.size();
        for (; oldest_ < count; ++oldest_) {
            double const after = elapsed_ - duration(hops[oldest_]);
            if (after < longest_return + 1) break;
            elapsed_ = after;
        }
        if (count == few) {
            seen_.assign(places, false);
            for (double const earlier : all_) seen_[place(step(earlier))] = true;
        }
        std::int64_t near = 0;
        if (count < few || may_repeat(step(now))) {
            for (std::size_t i = std::max(oldest_, since); i < count; ++i)
                near += static_cast<std::int64_t>(std::abs(all_[i] - now) < state_match);
        }
        if (count >= few) seen_[place(step(now))] = true;
        all_.push_back(now);
        elapsed_ += duration(hops.back());
        return near > 0;
    }

  private:
    static constexpr std::size_t few = 500;  // so few are compared faster than the bits are cleared
    static constexpr std::size_t places = std::size_t{1} << 20;
    static std::int64_t step(double rebound) {
        return static_cast<std::int64_t>(std::min(rebound, 1e9) * 1e9);
    }
    static std::size_t place(std::int64_t k) {
        return (static_cast<std::uint64_t>(k) * 0x9E3779B97F4A7C15U >> 32U) % places;
    }
    bool may_repeat(std::int64_t k) const {
        return seen_[place(k)] || seen_[place(k - 1)] || seen_[place(k + 1)];
    }

    std::vector<double>& all_;
    std::vector<bool>& seen_;
    std::size_t oldest_ = 0;  ///< that counts
    double elapsed_ = 0;      ///< from its start to the end of the last one
};

/// The growth of small changes, which may exceed the range of numbers.
class Growth {
  public:
    void multiply(Sensitivity const& s) {
        product_ = s.after(product_);
        double const size = product_.size();
        if (within_range(size)) return;
        logarithm_ += std::log(size);
        product_ = {product_.phase_phase / size, product_.phase_rate / size, product_.rate_phase / size,
                    product_.rate_rate / size};
    }
    double logarithm() const { return logarithm_ + std::log(product_.size()); }
    double factor() const { return logarithm_ == 0 ? product_.size() : std::exp(logarithm()); }

  private:
    static bool within_range(double x) { return (x > 1e-100 && x < 1e100) || !(x > 0) || !std::isfinite(x); }
    Sensitivity product_;
    double logarithm_ = 0;
};

int cycles_from(std::vector<Hop> const& hops, std::size_t first) {
    double length = 0;
    for (std::size_t i = first; i < hops.size(); ++i) length += duration(hops[i]);
    return static_cast<int>(std::lround(length / two_pi));
}

}  // namespace

FlightChain::Start with_rounding(FlightChain::Start start, std::size_t number) {
    if (start.zero >= 0) start.at.t += rounding * static_cast<double>(number);
    return start;
}

void find_normal_orbit(ConveyorWaves const& waves, NormalOrbit& orbit) {
    orbit.hops.clear();
    orbit.first = 0;
    orbit.cycles = 0;
    orbit.in_doubt = false;
    orbit.in_contact = waves.presses().none();
    if (orbit.in_contact) {
        orbit.cycles = 1;
        return;
    }
    FlightChain const chain(waves);
    FlightChain::Start next = chain.first();
    Growth growth;
    double chaos_start = HUGE_VAL, peak = 1;  // of the growth since the last contact
    bool irregular = false;
    std::size_t since = 0;  // the last contact
    Rebounds rebounds(orbit.rebounds, orbit.seen);
    orbit.left_at.assign(waves.presses().count(), never);
    for (double elapsed = next.at.t; elapsed < two_pi * most_cycles;) {
        if (next.zero >= 0) {
            std::size_t& before = orbit.left_at[static_cast<std::size_t>(next.zero)];
            bool const returns = before != never;
            if (returns && peak < most_growth) {
                orbit.first = before;
                orbit.cycles = cycles_from(orbit.hops, before);
                break;
            }
            orbit.in_doubt = returns && peak < hopeless_growth;
            if (orbit.in_doubt) break;
            before = since = orbit.hops.size();
            // Rounding decides what happens after such a growth: a motion that ends elsewhere is to be found.
            if (returns) next = with_rounding(next, orbit.hops.size());
            irregular = irregular || returns;
            growth = {};
            peak = 1;
            chaos_start = std::min(chaos_start, 0.0);
        }
        FlightChain::Start const start = next;
        Hop const hop = chain.fly(start, next);
        orbit.hops.push_back(hop);
        elapsed += duration(hop);
        growth.multiply(chain.sensitivity(hop, start.rate));
        if (peak < hopeless_growth) peak = std::max(peak, growth.factor());
        if (chaos_start == HUGE_VAL && elapsed > two_pi * chaos_from) chaos_start = growth.logarithm();
        if (elapsed > two_pi * chaos_to &&
            (irregular || growth.logarithm() - chaos_start > std::log(chaotic_growth)))
            break;
        bool const returned = rebounds.repeat(orbit.hops, since);
        std::size_t const k = next.zero >= 0 || !returned ? 0 : hops_to_return(orbit.hops, since);
        if (k > 0) {
            orbit.first = orbit.hops.size() - k;
            orbit.cycles = cycles_from(orbit.hops, orbit.first);
            break;
        }
    }
    orbit.next = next;
}

}  // namespace vibrotrough::theory::detail
