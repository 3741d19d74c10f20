#include "measure/case_estimate.hpp"

#include "measure/drift.hpp"
#include "measure/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace vibrotrough::measure {
namespace {

/// Share of the error probability that an interval may use after packings were added until it was narrow.
constexpr double stopping_share = 0.5;
/// Level of the tests for drift and for branches: they are repeated after every round of packings.
constexpr double test_level = 0.99;
/// Fewest packings of a group that can be compared with the other group.
constexpr int fewest_of_group = 2;

double mean_of(std::span<double const> values) {
    return as_array(values).mean();
}

double variance_of(std::span<double const> values) {
    if (values.size() < 2) return 0;
    return (as_array(values) - mean_of(values)).square().sum() / static_cast<double>(values.size() - 1);
}

std::vector<double> means_of(Runs runs, int first, int last) {
    std::vector<double> means;
    for (std::span<double const> const run : runs)
        means.push_back(
            mean_of(run.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first))));
    return means;
}

/// Whether the mean of a sample differs from zero.
bool is_significant(std::span<double const> differences, double level) {
    auto const n = static_cast<double>(differences.size());
    if (n < 2) return false;
    return std::abs(mean_of(differences)) >
           student_quantile(level, n - 1) * std::sqrt(variance_of(differences) / n);
}

/// Whether the start-up takes half of the cycles and the mean of all packings still changes.
bool is_starting_up(Runs packings, int discarded, double tolerated) {
    int const n = static_cast<int>(packings.front().size());
    if (2 * discarded + 1 < n) return false;
    if (n < 4) return true;
    double const before = mean_of(means_of(packings, n / 4, n / 2));
    return std::abs(mean_of(means_of(packings, discarded, n)) - before) > tolerated;
}

/// Whether the packings drift in the same direction.
bool is_drifting(Runs packings, int discarded, double tolerated) {
    int const n = static_cast<int>(packings.front().size());
    int const middle = (discarded + n) / 2;
    if (middle == discarded) return false;
    std::vector<double> gains = means_of(packings, middle, n);
    std::vector<double> const before = means_of(packings, discarded, middle);
    for (std::size_t i = 0; i < gains.size(); ++i) gains[i] -= before[i];
    return std::abs(mean_of(gains)) > tolerated && is_significant(gains, test_level);
}

struct Group {
    std::vector<double> means;  ///< one per packing

    std::optional<Branch> branch(double confidence) const {
        if (means.empty()) return {};
        Branch branch{mean_of(means), {}, static_cast<int>(means.size())};
        if (branch.packings < 2) return branch;
        branch.half_width = student_quantile(confidence, branch.packings - 1) *
                            std::sqrt(variance_of(means) / branch.packings);
        return branch;
    }
};

/// Whether the two groups differ: the two-sample t test with a common variance.
bool is_branching(Group const& below, Group const& above, double tolerated) {
    auto const n = static_cast<double>(below.means.size()), m = static_cast<double>(above.means.size());
    if (std::min(n, m) < fewest_of_group) return false;
    double const difference = std::abs(mean_of(above.means) - mean_of(below.means));
    double const variance =
        ((n - 1) * variance_of(below.means) + (m - 1) * variance_of(above.means)) / (n + m - 2);
    return difference > tolerated &&
           difference > student_quantile(test_level, n + m - 2) * std::sqrt(variance * (1 / n + 1 / m));
}

/// Student's interval of a mean over `packings`.
struct Deviation {
    double value;               ///< of the mean of one packing
    double degrees_of_freedom;  ///< that it rests on
};

Deviation deviation_of(std::vector<double> const& means, double within, double freedom_within) {
    double const between = variance_of(means);  // contains the fluctuations within the runs
    double const freedom = static_cast<double>(means.size()) - 1;
    double const variance_within = within * within;
    if (between > variance_within) return {std::sqrt(between), freedom};
    double const both = freedom + freedom_within;
    double const pooled = (freedom * between + freedom_within * variance_within) / both;
    return {std::sqrt(std::max(pooled, variance_within)), both};
}

/// Mean and Student's interval, without what is left of a start-up.
void add_interval(CaseEstimate& estimate, std::vector<double> const& means, Fluctuations const& within,
                  double level) {
    estimate.correlation_time = within.inefficiency;
    estimate.deviation_within = std::sqrt(within.variance * within.inefficiency / estimate.measured);
    double const independent = estimate.packings * (estimate.measured / within.inefficiency);
    Deviation const deviation =
        deviation_of(means, estimate.deviation_within, std::max(1.0, independent - estimate.packings));
    estimate.mean = mean_of(means);
    estimate.deviation = deviation.value;
    estimate.half_width = student_quantile(level, deviation.degrees_of_freedom) * deviation.value /
                          std::sqrt(estimate.packings);
}

CaseEstimate estimate_single(PackingValues const& packing, Precision const& wanted, int startup) {
    PackingEstimate const one =
        estimate_packing_after(std::max(startup, startup_length(packing.values)), packing.values, wanted);
    CaseEstimate estimate;
    estimate.packings = 1;
    estimate.discarded = one.discarded;
    estimate.measured = one.measured;
    estimate.correlation_time = one.correlation_time;
    if (std::isfinite(one.mean)) estimate.mean = one.mean;
    // The correlation of a shorter series cannot be estimated well enough.
    bool const is_enough =
        one.measured >= fewest_cycles && one.measured >= fewest_independent * one.correlation_time;
    if (is_enough && std::isfinite(one.half_width)) estimate.half_width = one.half_width;
    if (one.verdict == Verdict::not_steady) estimate.steadiness = Steadiness::drifting;
    return estimate;
}

}  // namespace

double level_after_stopping(double confidence) {
    return 1 - stopping_share * (1 - confidence);
}

int common_startup_length(Runs runs) {
    std::vector<double> mean(runs.front().size(), 0.0);
    for (std::size_t i = 0; i < mean.size(); ++i)
        for (std::span<double const> const run : runs) mean[i] += run[i] / static_cast<double>(runs.size());
    return std::max(pooled_startup_length(runs), startup_length(mean));
}

CaseEstimate estimate_case(std::span<PackingValues const> packings, Precision const& wanted, int startup) {
    if (packings.empty()) throw std::invalid_argument("there are no packings to combine");
    std::size_t const n = packings.front().values.size();
    if (!std::ranges::all_of(packings, [&](PackingValues const& one) { return one.values.size() == n; }))
        throw std::invalid_argument("the packings to combine have different numbers of cycles");
    if (packings.size() == 1) return estimate_single(packings.front(), wanted, startup);
    CaseEstimate estimate;
    estimate.packings = static_cast<int>(packings.size());
    if (n == 0) {
        estimate.steadiness = Steadiness::drifting;
        return estimate;
    }
    std::vector<std::span<double const>> runs, kept;
    for (PackingValues const& packing : packings) runs.push_back(packing.values);
    estimate.discarded = std::max(startup, common_startup_length(runs));
    estimate.measured = static_cast<int>(n) - estimate.discarded;
    for (std::span<double const> const run : runs)
        kept.push_back(run.last(static_cast<std::size_t>(estimate.measured)));
    std::vector<double> const means = means_of(kept, 0, estimate.measured);
    add_interval(estimate, means, fluctuations_of(kept), level_after_stopping(wanted.confidence));
    estimate.drift = drift_left(runs, estimate.discarded);
    estimate.half_width = std::hypot(*estimate.half_width, estimate.drift);

    Group below, above;
    for (std::size_t i = 0; i < packings.size(); ++i)
        (packings[i].start == Start::below ? below : above).means.push_back(means[i]);
    estimate.below = below.branch(level_after_stopping(wanted.confidence));
    estimate.above = above.branch(level_after_stopping(wanted.confidence));
    double const tolerated = wanted.half_width;
    if (is_branching(below, above, tolerated)) {
        estimate.steadiness = Steadiness::branching;
    } else if (is_starting_up(runs, estimate.discarded, tolerated) ||
               is_drifting(runs, estimate.discarded, tolerated)) {
        estimate.steadiness = Steadiness::drifting;
    }
    return estimate;
}

bool is_precise(CaseEstimate const& estimate, Precision const& wanted) {
    return estimate.half_width && *estimate.half_width <= wanted.half_width;
}

std::optional<int> packings_needed(CaseEstimate const& estimate, Precision const& wanted) {
    constexpr int most = 1'000'000;
    if (!estimate.deviation) return {};
    double const level = level_after_stopping(wanted.confidence);
    // The quantile depends on the number that is looked for; a few rounds settle it.
    double needed = std::max(2, estimate.packings);
    for (int round = 0; round < 50; ++round) {
        double const quantile = student_quantile(level, std::max(1.0, needed - 1));
        double const next =
            std::clamp(std::pow(quantile * *estimate.deviation / wanted.half_width, 2), 2.0, 1.0 * most);
        if (std::abs(next - needed) < 0.5) break;
        needed = (needed + next) / 2;
    }
    return static_cast<int>(std::min<double>(most, std::ceil(needed)));
}

}  // namespace vibrotrough::measure
