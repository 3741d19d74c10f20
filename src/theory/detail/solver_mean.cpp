#include "theory/detail/fixed_point.hpp"
#include "theory/detail/solver.hpp"

#include <algorithm>
#include <cmath>

// The mean of a motion without a period.
namespace vibrotrough::theory::detail {
namespace {

// Motions without a period. Batches become longer until the half-width is as wanted. Each also has half as
// many flights as cycles: a mean over a part of a flight says nothing of the motion.
constexpr int settling = 100, shortest_batch = 16, longest_batch = 128;  // cycles
constexpr std::size_t batch_count = 20;
constexpr double wanted_half_width = 0.01;
// One motion in ten without a period changes its manner over thousands of cycles, which batches do not show:
// with this factor the intervals held 95 % of 500 means over 200,000 cycles, and without it 92 %.
constexpr double slow_changes = 1.5;
constexpr std::size_t most_notes = 20000;  // kept of a motion without a period, beside its last batch

}  // namespace

/// Follows at least so many cycles, and half as many flights, of a motion without a period from the start of
/// hop number `hop`, and adds hops where there are not enough.
ConveyorSolver::Batch ConveyorSolver::follow_cycles(Tangent& s, std::size_t& hop, int cycles) {
    FlightChain const chain(forces_);
    ContactLaw const law(forces_);
    Batch batch;
    auto const record = [&](PhaseKind kind, double from, double to, double speed, double distance, double) {
        batch.moved += distance;
        if (keep_) notes_.add(kind, hop, from, to, speed, distance);
    };
    double const before = s.v;
    for (std::size_t const first = hop;
         batch.elapsed < two_pi * cycles || 2 * (hop - first) < static_cast<std::size_t>(cycles); ++hop) {
        if (hop == orbit_.hops.size()) {
            FlightChain::Start const start = with_rounding(orbit_.next, orbit_.hops.size());
            orbit_.hops.push_back(chain.fly(start, orbit_.next));
        }
        Hop const& now = orbit_.hops[hop];
        hints_.restart();
        s = follow_hop(law, now, leap(forces_, now), s, hints_, record);
        batch.elapsed += now.leave.t - now.start.t;
    }
    batch.gained = s.v - before;
    return batch;
}

namespace {

using Batch = ConveyorSolver::Batch;

/// Two batches after each other become one.
void join_pairs(std::vector<Batch>& batches) {
    for (std::size_t i = 0; i < batches.size() / 2; ++i) {
        Batch const &one = batches[2 * i], &next = batches[2 * i + 1];
        batches[i] = {one.elapsed + next.elapsed, one.moved + next.moved, one.gained + next.gained};
    }
    batches.resize(batches.size() / 2);
}

Batch sum_of(std::vector<Batch> const& batches) {
    Batch sum;
    for (Batch const& one : batches)
        sum = {sum.elapsed + one.elapsed, sum.moved + one.moved, sum.gained + one.gained};
    return sum;
}

/// Half the 95 % confidence interval of the mean of 20 batches (Student's t): the largest of those of 20, 10
/// and 5 batches. Where it grows with the length of the batches, they are too short: their means are not
/// independent. The copy is small.
double half_width_of(std::vector<Batch> batches) {
    double largest = 0, mean = sum_of(batches).mean();
    // Quantiles 0.975 for 19, 9 and 4 degrees of freedom.
    for (double const student : {2.0930240544083092, 2.2621571627982049, 2.7764451051977934}) {
        auto const n = static_cast<double>(batches.size());
        double squares = 0;
        for (Batch const& one : batches) squares += (one.mean() - mean) * (one.mean() - mean);
        largest = std::max(largest, student * std::sqrt(squares / (n - 1) / n));
        join_pairs(batches);
    }
    return slow_changes * largest;
}

}  // namespace

/// @param first  hop from which the cycles are followed; the leaps before it are known
Efficiency ConveyorSolver::average(std::size_t first) {
    if (mean_ == Mean::left_out) return {0, 0, 0, Outcome::unsettled};
    orbit_.first = first;
    Tangent s = follow_from_start();
    std::size_t hop = first;
    follow_cycles(s, hop, settling);
    std::vector<Batch> batches;
    notes_.clear();
    s.slope = 1;
    double half_width = HUGE_VAL;
    for (int cycles = shortest_batch;; cycles *= 2) {
        while (batches.size() < batch_count) {
            if (notes_.size() > most_notes) notes_.clear();
            batches.push_back(follow_cycles(s, hop, cycles));
        }
        half_width = half_width_of(batches);
        if (cycles == longest_batch || half_width <= wanted_half_width) break;
        join_pairs(batches);
    }
    if (gets_ever_faster(s, batches)) return running_away();
    Batch const all = sum_of(batches);
    cycles_followed_ = all.elapsed / two_pi;
    // Drag takes 1 / kappa to bring a mass that nothing stops to its speed, at which it gains no more.
    double const drag = forces_.drag(), kept = std::exp(-drag * all.elapsed);
    bool const is_free = kept > 1e-6 && std::abs(s.slope / kept - 1) < 1e-6;
    if (drag > 0 && is_free && std::abs(all.gained / all.elapsed) > drag * half_width) {
        for (Batch& one : batches) one.moved += one.gained / drag;
        return {sum_of(batches).mean(), 0, 0, Outcome::unsettled, half_width_of(batches)};
    }
    return {all.mean(), 0, 0, Outcome::unsettled, half_width};
}

/// Whether nothing has stopped the mass in any batch, and it was faster from each to the next. (20 means are
/// in order by chance once in 1e18 times.)
bool ConveyorSolver::gets_ever_faster(Tangent const& s, std::vector<Batch> const& batches) const {
    double const downhill = -std::copysign(1.0, forces_.gravity());
    auto const is_slower = [&](Batch const& p, Batch const& q) {
        return downhill * p.mean() < downhill * q.mean();
    };
    return forces_.drag() == 0 && s.slope == 1 && downhill * s.v > 0 &&
           std::is_sorted(batches.begin(), batches.end(), is_slower);
}

}  // namespace vibrotrough::theory::detail
