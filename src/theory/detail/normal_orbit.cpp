#include "theory/detail/normal_orbit.hpp"

#include <algorithm>

namespace vibrotrough::theory::detail {
namespace {

// Of phase and rate, from period to period. A motion beside a change of its period settles slowly: it has the
// first half of the flights for the closer match.
constexpr double close_match = 1e-13, state_match = 1e-11;
// A motion is followed for so many cycles, and for as many flights where these are longer.
constexpr int longest_normal_period = 64, most_normal = 3000;
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

/// The number of hops after which the phase of the landing and the rebound repeat; 0 when they do not.
/// @param since  the first hop after the last contact
/// @param match  by what they may differ
std::size_t hops_to_return(std::vector<Hop> const& hops, std::size_t since, double match) {
    constexpr double longest = two_pi * (longest_normal_period + 0.5);
    Hop const& now = hops.back();
    double elapsed = 0;
    for (std::size_t k = 1; k + since < hops.size() && (elapsed < longest || k <= longest_normal_period);
         ++k) {
        Hop const& earlier = hops[hops.size() - 1 - k];
        elapsed += duration(earlier);
        if (!(std::abs(now.rebound - earlier.rebound) < match) || !(difference(now, earlier) < match))
            continue;
        for (std::size_t shorter = 1; shorter < k; ++shorter) {
            // An alternating approach meets the tolerance for 2 before it does for 1.
            if (k % shorter == 0 && difference(now, hops[hops.size() - 1 - shorter]) < 1e3 * match)
                return shorter;
        }
        return k;
    }
    return 0;
}

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

void find_normal_orbit(Forces const& forces, MotionStart const& start, NormalOrbit& orbit,
                       std::vector<std::size_t> const* after_zero) {
    orbit.hops.clear();
    orbit.again.clear();
    orbit.first = 0;
    orbit.cycles = 0;
    orbit.in_doubt = false;
    orbit.joined = never;
    orbit.begin = start.at;
    FlightChain const chain(forces);
    FlightChain::Start next = chain.from(start);
    orbit.in_contact = !std::isfinite(next.at.t);
    orbit.left_at.assign(forces.presses().count(), never);
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
    double elapsed = next.at.t;
    auto const has_followed = [&](int count) {
        return elapsed > two_pi * count && orbit.hops.size() > static_cast<std::size_t>(count);
    };
    while (!has_followed(most_normal)) {
        if (next.zero >= 0) {
            if (after_zero != nullptr) orbit.joined = (*after_zero)[static_cast<std::size_t>(next.zero)];
            if (orbit.joined != never) break;
            std::size_t& before = orbit.left_at[static_cast<std::size_t>(next.zero)];
            bool const returns = before != never;
            if (returns && peak < hopeless_growth) {
                orbit.first = before;
                orbit.cycles = cycles_from(orbit.hops, before);
                orbit.in_doubt = peak >= most_growth && forces.restitution() > 0;
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
        growth.multiply(chain.sensitivity(hop, from.rate));
        if (peak < hopeless_growth) peak = std::max(peak, growth.factor());
        if (chaos_start == HUGE_VAL && has_followed(chaos_from)) chaos_start = growth.logarithm();
        // Where rounding has decided what follows a contact, the motion may still end elsewhere.
        bool const chaotic = growth.logarithm() - chaos_start > std::log(chaotic_growth);
        if (has_followed(chaos_to) && chaotic && !irregular) break;
        if (next.zero >= 0) continue;
        double const match = has_followed(most_normal / 2) ? state_match : close_match;
        std::size_t const k = hops_to_return(orbit.hops, since, match);
        if (k > 0) {
            orbit.first = orbit.hops.size() - k;
            orbit.cycles = cycles_from(orbit.hops, orbit.first);
            break;
        }
    }
    orbit.next = next;
}

}  // namespace vibrotrough::theory::detail
