#include "theory/detail/common/fixed_point.hpp"
#include "theory/detail/conveyor/solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>

// The mean of a motion without a period.
namespace vibrotrough::theory::detail {
namespace {

// Motions without a period. Batches become longer until the half-width is as wanted.
constexpr int settling = 100, shortest_batch = 16, longest_batch = 128;  // cycles
constexpr std::size_t batch_count = 20;
constexpr int flights_per_batch = 8;
constexpr double wanted_half_width = 0.01;
// One motion in ten without a period changes its manner over thousands of cycles, which batches do not show:
// with this factor the intervals held 95 % of 500 means over 200,000 cycles, and without it 92 %.
constexpr double slow_changes = 1.5;
constexpr std::size_t most_notes = 20000;  // kept of a motion without a period, beside its last batch

}  // namespace

/// Follows at least so many cycles of a motion without a period, from the start of hop number `hop`, and adds
/// hops where there are not enough. @return the mean slip velocity; not a number when a flight is too long
double ConveyorSolver::follow_cycles(Tangent& s, std::size_t& hop, double cycles) {
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
        if (longest_flight_ * flights_per_batch > two_pi * longest_batch * unit_) return NAN;
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

/// @param first  hop from which the cycles are followed; the leaps before it are known
Efficiency ConveyorSolver::average(std::size_t first) {
    if (mean_ == Mean::left_out) return {0, 0, 0, Outcome::unsettled};
    orbit_.first = first;
    for (unit_ = std::ceil(orbit_.stretch);;) {
        if (auto const mean = average_of_batches()) return *mean;
        // A flight can last thousands of cycles, and the mean over a part of one says nothing of the motion.
        while (longest_flight_ * flights_per_batch > two_pi * longest_batch * unit_) unit_ *= 2;
        unit_ *= 2;
    }
}

/// Nothing when a flight is so long that a batch would have too few of them.
std::optional<Efficiency> ConveyorSolver::average_of_batches() {
    Tangent s = follow_from_start();
    std::size_t hop = orbit_.first;
    longest_flight_ = 0;
    if (std::isnan(follow_cycles(s, hop, settling * unit_))) return std::nullopt;
    batches_.clear();
    notes_.clear();
    double half_width = HUGE_VAL;
    cycles_followed_ = 0;
    gains_.clear();
    s.slope = 1;
    for (int cycles = shortest_batch;; cycles *= 2) {
        while (batches_.size() < batch_count) {
            if (notes_.size() > most_notes) notes_.clear();
            double const before = s.v;
            batches_.push_back(follow_cycles(s, hop, cycles * unit_));
            if (std::isnan(batches_.back())) return std::nullopt;
            gains_.push_back((s.v - before) / (two_pi * cycles * unit_));
        }
        half_width = half_width_of(batches_);
        bool const has_flights = longest_flight_ * flights_per_batch <= two_pi * cycles * unit_;
        if (cycles == longest_batch || (has_flights && half_width <= wanted_half_width)) break;
        join_pairs(batches_);
        join_pairs(gains_);
    }
    if (gets_ever_faster(s)) return running_away();
    double const mean = mean_of(batches_);
    // Drag takes 1 / kappa to bring a mass that nothing stops to its speed, at which it gains no more.
    double const kept = std::exp(-waves_.drag() * two_pi * cycles_followed_);
    bool const is_free = kept > 1e-6 && std::abs(s.slope / kept - 1) < 1e-6;
    if (waves_.drag() > 0 && is_free && std::abs(mean_of(gains_)) > waves_.drag() * half_width) {
        for (std::size_t i = 0; i < batch_count; ++i) batches_[i] += gains_[i] / waves_.drag();
        return Efficiency{mean_of(batches_), 0, 0, Outcome::unsettled, half_width_of(batches_)};
    }
    return Efficiency{mean, 0, 0, Outcome::unsettled, half_width};
}

/// Whether nothing has stopped the mass in any batch, and it was faster from each to the next. (20 means are
/// in order by chance once in 1e18 times.)
bool ConveyorSolver::gets_ever_faster(Tangent const& s) const {
    double const downhill = -std::copysign(1.0, waves_.gravity());
    auto const is_slower = [&](double p, double q) { return downhill * p < downhill * q; };
    return waves_.drag() == 0 && s.slope == 1 && downhill * s.v > 0 &&
           std::is_sorted(batches_.begin(), batches_.end(), is_slower);
}

}  // namespace vibrotrough::theory::detail
