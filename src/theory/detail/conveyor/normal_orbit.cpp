#include "theory/detail/conveyor/normal_orbit.hpp"

#include <algorithm>
#include <cstdint>

namespace vibrotrough::theory::detail {
namespace {

constexpr double state_match = 1e-11;  // of phase and rate, from period to period
constexpr int longest_normal_period = 64, most_normal_cycles = 3000;
// A motion is chaotic if small changes grow by this factor between these cycles.
constexpr double chaotic_growth = 1e10;
constexpr int chaos_from = 500, chaos_to = 1000;
// A period within which small changes grow by the first factor is in doubt, because rounding errors grow as
// well. From the second factor on there is none.
constexpr double most_growth = 1e6, hopeless_growth = 1e11, rounding = 1e-16;

/// The difference of the states at two landings; multiples of a cycle do not count.
double difference(Hop const& a, Hop const& b) {
    double const turns = (a.end.t - b.end.t) * (1 / two_pi);
    return std::max(std::abs(a.rebound - b.rebound), two_pi * std::abs(turns - std::round(turns)));
}

double duration(Hop const& hop) {
    return hop.leave.t - hop.start.t;
}

// What is said of cycles holds for flights of up to this duration, and for restitutions up to the second
// number: beyond, the energy settles over more impacts than a hundred cycles have.
constexpr double ordinary_flight = 16 * two_pi, lively = 0.95, settling_cycles = 100;  // rad, 1, cycles
constexpr double longest_stretch = 5e5;

/// By how much the restitution stretches the times in which a motion settles.
double stretch_by(ConveyorWaves const& waves) {
    double const e = waves.restitution();
    if (e <= lively) return 1;
    // The velocity of a rebound W changes to e W + (1 + e) V, with the velocity V of the trough.
    double const impacts = 1 / (1 - e * e), rebound = waves.vy().bound() * std::sqrt((1 + e) / (1 - e) / 2);
    double const flight = rebound / waves.weight() / pi;  // cycles
    return std::clamp(std::ceil(5 * impacts * flight / settling_cycles), 1.0, longest_stretch);
}

double longest_return(double stretch) {
    return two_pi * (longest_normal_period + 0.5) * stretch;
}

/// The number of hops after which the phase of the landing and the rebound repeat; 0 when they do not.
/// @param since  the first hop after the last contact
/// @param most   rad, the longest period
std::size_t hops_to_return(std::vector<Hop> const& hops, std::size_t since, double most) {
    Hop const& now = hops.back();
    double elapsed = 0;
    for (std::size_t k = 1; k + since < hops.size() && elapsed < most; ++k) {
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

    /// Adds the last of the hops.
    /// @param since  the first hop after the last contact
    /// @param most   rad, the longest period
    bool repeat(std::vector<Hop> const& hops, std::size_t since, double most) {
        double const now = hops.back().rebound;
        std::size_t const count = all_.size();
        for (; oldest_ < count; ++oldest_) {
            double const after = elapsed_ - duration(hops[oldest_]);
            if (after < most + 1) break;
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

/// The period after the one that was found, with a rounding error of its own.
void fly_again(FlightChain const& chain, FlightChain::Start const& start, NormalOrbit& orbit) {
    constexpr double closing = 1e-3;  // rad: rounding errors have grown to less than that
    FlightChain::Start next = with_rounding(start, orbit.hops.size());
    for (double left = two_pi * orbit.cycles; left > closing;) {
        FlightChain::Start const from = next;
        orbit.again.push_back(chain.fly(from, next));
        left -= duration(orbit.again.back());
    }
    if (next.zero != start.zero) orbit.again.clear();
}

/// The mass has come to lie on a trough that it never leaves again.
void stay_in_contact(NormalOrbit& orbit) {
    Hop& last = orbit.hops.back();
    last.leave = {two_pi * std::ceil(last.end.t * (1 / two_pi)), 0, 1};
    orbit.first = orbit.hops.size();
    orbit.in_contact = true;
    orbit.cycles = 1;
}

}  // namespace

FlightChain::Start with_rounding(FlightChain::Start start, std::size_t number) {
    if (start.zero >= 0) start.at.t += rounding * static_cast<double>(number);
    return start;
}

void find_normal_orbit(ConveyorWaves const& waves, MotionStart const& start, NormalOrbit& orbit,
                       std::vector<std::size_t> const* after_zero) {
    orbit.hops.clear();
    orbit.again.clear();
    orbit.first = 0;
    orbit.cycles = 0;
    orbit.in_doubt = false;
    orbit.joined = never;
    orbit.stretch = stretch_by(waves);
    orbit.begin = start.at;
    FlightChain const chain(waves);
    FlightChain::Start next = chain.from(start);
    orbit.in_contact = !std::isfinite(next.at.t);
    orbit.left_at.assign(waves.presses().count(), never);
    if (orbit.in_contact) {
        orbit.cycles = 1;
        return;
    }
    double const ahead = two_pi * std::floor(next.at.t * (1 / two_pi));
    next.at.t -= ahead;
    orbit.begin.t -= ahead;
    Growth growth;
    double chaos_start = HUGE_VAL, peak = 1;  // of the growth since the last contact
    bool irregular = false;
    std::size_t since = 0;  // the last contact
    Rebounds rebounds(orbit.rebounds, orbit.seen);
    for (double elapsed = next.at.t; elapsed < two_pi * most_normal_cycles * orbit.stretch;) {
        if (next.zero >= 0) {
            if (after_zero != nullptr) orbit.joined = (*after_zero)[static_cast<std::size_t>(next.zero)];
            if (orbit.joined != never) break;
            std::size_t& before = orbit.left_at[static_cast<std::size_t>(next.zero)];
            bool const returns = before != never;
            if (returns && peak < hopeless_growth) {
                orbit.first = before;
                orbit.cycles = cycles_from(orbit.hops, before);
                orbit.in_doubt = peak >= most_growth;
                if (orbit.in_doubt) fly_again(chain, next, orbit);
                break;
            }
            before = since = orbit.hops.size();
            // Rounding decides what happens after such a growth: a motion that ends elsewhere is to be found.
            if (returns) next = with_rounding(next, orbit.hops.size());
            irregular = irregular || returns;
            growth = {};
            peak = 1;
            chaos_start = std::min(chaos_start, 0.0);
        }
        FlightChain::Start const from = next;
        Hop const hop = chain.fly(from, next);
        orbit.hops.push_back(hop);
        if (!std::isfinite(hop.leave.t)) {
            stay_in_contact(orbit);
            break;
        }
        elapsed += duration(hop);
        orbit.stretch = std::max(orbit.stretch, (hop.end.t - hop.start.t) / ordinary_flight);
        growth.multiply(chain.sensitivity(hop, from.rate));
        if (peak < hopeless_growth) peak = std::max(peak, growth.factor());
        if (chaos_start == HUGE_VAL && elapsed > two_pi * chaos_from * orbit.stretch)
            chaos_start = growth.logarithm();
        if (elapsed > two_pi * chaos_to * orbit.stretch &&
            (irregular || growth.logarithm() - chaos_start > std::log(chaotic_growth)))
            break;
        double const most = longest_return(orbit.stretch);
        bool const returned = rebounds.repeat(orbit.hops, since, most);
        std::size_t const k = next.zero >= 0 || !returned ? 0 : hops_to_return(orbit.hops, since, most);
        if (k > 0) {
            orbit.first = orbit.hops.size() - k;
            orbit.cycles = cycles_from(orbit.hops, orbit.first);
            break;
        }
    }
    orbit.next = next;
}

}  // namespace vibrotrough::theory::detail
