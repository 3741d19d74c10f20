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

/// Follows the flights until their period is known, or that there is none.
class PeriodSearch {
  public:
    PeriodSearch(Forces const& forces, FlightChain::Start const& first, NormalOrbit& orbit,
                 std::vector<std::size_t> const* after_zero)
        : chain_(forces),
          may_doubt_(forces.restitution() > 0),
          after_zero_(after_zero),
          next_(first),
          elapsed_(first.at.t),
          orbit_(orbit) {}

    void run() {
        while (!has_followed(most_normal)) {
            if ((next_.zero >= 0 && leaves_contact()) || flies()) break;
        }
        orbit_.next = next_;
    }

  private:
    bool has_followed(int count) const {
        return elapsed_ > two_pi * count && orbit_.hops.size() > static_cast<std::size_t>(count);
    }
    void found(std::size_t first) {
        orbit_.first = first;
        orbit_.cycles = cycles_from(orbit_.hops, first);
    }
    bool leaves_contact();
    bool flies();

    FlightChain chain_;
    bool may_doubt_;
    std::vector<std::size_t> const* after_zero_;
    FlightChain::Start next_;
    double elapsed_;
    NormalOrbit& orbit_;
    Growth growth_;                  // since the last contact
    double peak_ = 1;                // of it
    double chaos_start_ = HUGE_VAL;  // its logarithm where chaos is looked for
    bool irregular_ = false;         // rounding has decided what follows a contact
    std::size_t since_ = 0;          // hop after the last contact
};

/// At a take-off from contact: what follows does not depend on what was before. @return whether it is known
bool PeriodSearch::leaves_contact() {
    auto const zero = static_cast<std::size_t>(next_.zero);
    if (after_zero_ != nullptr) orbit_.joined = (*after_zero_)[zero];
    if (orbit_.joined != never) return true;
    std::size_t& before = orbit_.left_at[zero];
    bool const returns = before != never;
    if (returns && peak_ < hopeless_growth) {
        found(before);
        orbit_.in_doubt = peak_ >= most_growth && may_doubt_;
        if (orbit_.in_doubt) fly_again(chain_, next_, orbit_);
        return true;
    }
    before = since_ = orbit_.hops.size();
    // Rounding decides what happens after such a growth: a motion that ends elsewhere is to be found.
    if (returns) next_ = with_rounding(next_, orbit_.hops.size());
    irregular_ = irregular_ || returns;
    growth_ = {};
    peak_ = 1;
    chaos_start_ = std::min(chaos_start_, 0.0);
    return false;
}

/// The next flight. @return whether no more is to be found
bool PeriodSearch::flies() {
    FlightChain::Start const from = next_;
    Hop const hop = chain_.fly(from, next_);
    orbit_.hops.push_back(hop);
    if (!std::isfinite(hop.leave.t)) {
        stay_in_contact(orbit_);
        return true;
    }
    elapsed_ += duration(hop);
    growth_.multiply(chain_.sensitivity(hop, from.rate));
    if (peak_ < hopeless_growth) peak_ = std::max(peak_, growth_.factor());
    if (chaos_start_ == HUGE_VAL && has_followed(chaos_from)) chaos_start_ = growth_.logarithm();
    // An irregular motion may still end elsewhere.
    if (has_followed(chaos_to) && !irregular_ &&
        growth_.logarithm() - chaos_start_ > std::log(chaotic_growth))
        return true;
    if (next_.zero >= 0) return false;
    double const match = has_followed(most_normal / 2) ? state_match : close_match;
    std::size_t const k = hops_to_return(orbit_.hops, since_, match);
    if (k > 0) found(orbit_.hops.size() - k);
    return k > 0;
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
    FlightChain::Start next = FlightChain(forces).from(start);
    orbit.in_contact = !std::isfinite(next.at.t);
    orbit.left_at.assign(forces.presses().count(), never);
    if (orbit.in_contact) {
        orbit.cycles = 1;
        return;
    }
    double const ahead = two_pi * std::floor(next.at.t * (1 / two_pi));
    next.at.t -= ahead;
    orbit.begin.t -= ahead;
    PeriodSearch(forces, next, orbit, after_zero).run();
}

}  // namespace vibrotrough::theory::detail
