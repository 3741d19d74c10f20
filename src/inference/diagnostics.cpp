#include "inference/diagnostics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <stdexcept>

#include <boost/math/special_functions/erf.hpp>

namespace vibrotrough::inference {
namespace {

using Halves = std::vector<std::span<double const>>;

/// The chains cut into halves of equal length; the middle value of an odd number is left out.
Halves split(std::vector<double> const& values, int count) {
    auto const length = values.size() / static_cast<std::size_t>(count);
    if (count < 1 || length < 8)
        throw std::invalid_argument("diagnostics: every chain needs at least eight values");
    std::span<double const> const all(values);
    Halves halves;
    for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c) {
        halves.push_back(all.subspan(c * length, length / 2));
        halves.push_back(all.subspan((c + 1) * length - length / 2, length / 2));
    }
    return halves;
}

/// Normal quantiles of the ranks (equal values share their mean rank), with Blom's fractions (r - 3/8) / (S +
/// 1/4).
std::vector<double> rank_normalised(std::vector<double> const& values) {
    std::size_t const n = values.size();
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<double> result(n);
    for (std::size_t first = 0; first < n;) {
        std::size_t last = first;
        while (last + 1 < n && values[order[last + 1]] == values[order[first]]) ++last;
        double const rank = static_cast<double>(first + last) / 2 + 1;
        double const fraction = (rank - 0.375) / (static_cast<double>(n) + 0.25);
        double const quantile = -std::sqrt(2.0) * boost::math::erfc_inv(2 * fraction);
        for (; first <= last; ++first) result[order[first]] = quantile;
    }
    return result;
}

double mean(std::span<double const> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Variances of split chains: within them, and of the pooled draws.
struct Variances {
    double within, pooled;
    std::vector<double> means;
};

Variances variances(Halves const& halves) {
    auto const n = static_cast<double>(halves.front().size());
    auto const m = static_cast<double>(halves.size());
    Variances result{0, 0, {}};
    for (auto const half : halves) {
        double const middle = mean(half);
        double squares = 0;
        for (double const v : half) squares += (v - middle) * (v - middle);
        result.within += squares / (n - 1) / m;
        result.means.push_back(middle);
    }
    double const middle = mean(result.means);
    double between = 0;
    for (double const v : result.means) between += (v - middle) * (v - middle) / (m - 1);
    result.pooled = (n - 1) / n * result.within + between;
    return result;
}

double split_rhat(std::vector<double> const& values, int count) {
    Variances const v = variances(split(values, count));
    return std::sqrt(v.pooled / v.within);
}

double autocovariance(std::span<double const> values, double middle, std::size_t lag) {
    double sum = 0;
    for (std::size_t i = 0; i + lag < values.size(); ++i)
        sum += (values[i] - middle) * (values[i + lag] - middle);
    return sum / static_cast<double>(values.size());
}

/// Geyer's initial monotone sequence: sums of neighbouring autocorrelations are kept while they are positive,
/// and never grow.
double split_ess(std::vector<double> const& values, int count) {
    Halves const halves = split(values, count);
    Variances const v = variances(halves);
    auto const n = halves.front().size();
    double const total = static_cast<double>(n * halves.size());
    if (!(v.pooled > 0)) return total;  // a constant is known exactly
    double const unbiased = static_cast<double>(n) / static_cast<double>(n - 1);
    auto const correlation = [&](std::size_t lag) {
        double sum = 0;
        for (std::size_t h = 0; h < halves.size(); ++h) sum += autocovariance(halves[h], v.means[h], lag);
        return 1 - (v.within - unbiased * sum / static_cast<double>(halves.size())) / v.pooled;
    };
    double time = -1, last = 2;
    for (std::size_t lag = 0; lag + 1 < n; lag += 2) {
        double const pair = std::min(last, correlation(lag) + correlation(lag + 1));
        if (!(pair > 0)) break;
        time += 2 * pair;
        last = pair;
    }
    // Antithetic chains may beat independent draws, but not without bound (Vehtari et al. 2021, section 3).
    return total / std::max(time, 1 / std::log10(total));
}

std::vector<double> distances_to_median(std::vector<double> values) {
    double const median = quantile(values, 0.5);
    for (double& v : values) v = std::abs(v - median);
    return values;
}

}  // namespace

double rank_normalised_rhat(Chains const& chains) {
    return std::max(split_rhat(rank_normalised(chains.values), chains.count),
                    split_rhat(rank_normalised(distances_to_median(chains.values)), chains.count));
}

double effective_sample_size(Chains const& chains) {
    double smallest = split_ess(rank_normalised(chains.values), chains.count);
    for (double const p : {0.05, 0.95}) {
        double const limit = quantile(chains.values, p);
        std::vector<double> below;
        for (double const v : chains.values) below.push_back(v <= limit ? 1 : 0);
        smallest = std::min(smallest, split_ess(below, chains.count));
    }
    return smallest;
}

double quantile(std::vector<double> values, double p) {
    double const place = p * static_cast<double>(values.size() - 1);
    auto const below = static_cast<std::ptrdiff_t>(std::floor(place));
    std::ranges::nth_element(values, values.begin() + below);
    double const low = values[static_cast<std::size_t>(below)];
    if (place == std::floor(place)) return low;
    double const high = *std::min_element(values.begin() + below + 1, values.end());
    return low + (place - std::floor(place)) * (high - low);
}

}  // namespace vibrotrough::inference
