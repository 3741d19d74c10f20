#include "learn/known_friction.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <boost/math/special_functions/erf.hpp>
#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

constexpr double least_friction = 0.01;  // a normal distribution is cut here
constexpr double in_the_tail = 0.0015;   // of the distribution, on each side, in which limits are not kept
constexpr std::size_t least_draws = 100;
constexpr int uniform_draws = 20000;  // that stand for a range: five lie beyond 99.9 %
constexpr int middle_parts = 5;       // of few_parts(), between the tails
constexpr int parts_of_a_tail = 10;   // of many_parts(), and as many next to the tail

double normal_quantile(double p) {
    return -std::sqrt(2.0) * boost::math::erfc_inv(2 * p);
}

std::size_t place(double share, std::size_t count) {
    return static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
}

}  // namespace

KnownFriction normal_friction(double median, double sd) {
    if (!(median >= least_friction && sd >= 0))
        throw std::invalid_argument(
            fmt::format("a friction of {:g} +- {:g} makes no sense: it must be at least {:g}", median, sd,
                        least_friction));
    return {median, std::max(least_friction, median - 3 * sd), median + 3 * sd, sd};
}

KnownFriction friction_between(double low, double high) {
    if (!(low >= least_friction && low <= high))
        throw std::invalid_argument(
            fmt::format("a friction of {:g} to {:g} makes no sense: it must be at least {:g}", low, high,
                        least_friction));
    KnownFriction known{(low + high) / 2, low, high};
    for (int i = 0; i < uniform_draws; ++i)
        known.draws.push_back(low + (high - low) * (i + 0.5) / uniform_draws);
    return known;
}

KnownFriction drawn_friction(std::vector<double> const& friction, std::vector<double> const& discrepancy) {
    if (friction.size() < least_draws || (!discrepancy.empty() && discrepancy.size() != friction.size()))
        throw std::invalid_argument(
            fmt::format("the posterior has {} draws of the friction; at least {} are needed", friction.size(),
                        least_draws));
    std::vector<std::size_t> order(friction.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [&](std::size_t i) { return friction[i]; });
    if (friction[order.front()] < 1e-3)
        throw std::invalid_argument("a friction of the posterior is below 0.001");
    auto const at = [&](double share) { return friction[order[place(share, order.size() - 1)]]; };
    KnownFriction known{at(0.5), at(in_the_tail), at(1 - in_the_tail)};
    for (std::size_t const i : order) {
        known.draws.push_back(friction[i]);
        if (!discrepancy.empty()) known.discrepancies.push_back(discrepancy[i]);
    }
    return known;
}

std::vector<FrictionPart> KnownFriction::parts(std::vector<double> const& ends) const {
    if (draws.empty() && sd == 0) return {{1, median, {}}};
    std::vector<FrictionPart> all;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (draws.empty()) {
            double const middle = median + sd * normal_quantile((ends[i] + ends[i + 1]) / 2);
            all.push_back({ends[i + 1] - ends[i], std::max(least_friction, middle), {}});
            continue;
        }
        std::size_t const first = place(ends[i], draws.size()), last = place(ends[i + 1], draws.size());
        if (first == last) continue;
        all.push_back({static_cast<double>(last - first) / static_cast<double>(draws.size()),
                       (draws[(first + last - 1) / 2] + draws[(first + last) / 2]) / 2,
                       {}});
        if (!discrepancies.empty())
            all.back().discrepancies.assign(discrepancies.begin() + static_cast<std::ptrdiff_t>(first),
                                            discrepancies.begin() + static_cast<std::ptrdiff_t>(last));
    }
    return all;
}

theory::Range KnownFriction::central(double share) const {
    double const tail = (1 - share) / 2;
    if (!draws.empty())
        return {draws[place(tail, draws.size() - 1)], draws[place(1 - tail, draws.size() - 1)]};
    if (sd == 0) return {median, median};
    double const half = sd * normal_quantile(1 - tail);
    return {std::max(least_friction, median - half), median + half};
}

std::vector<double> few_parts(double confidence) {
    double const tail = std::min(1 - confidence, 0.4);
    double const before = 0.8 * tail, after = 1.2 * tail;
    std::vector<double> ends{0, before};
    for (int i = 0; i <= middle_parts; ++i) ends.push_back(after + (1 - 2 * after) * i / middle_parts);
    ends.insert(ends.end(), {1 - before, 1});
    return ends;
}

std::vector<double> many_parts(double confidence, int equal_parts) {
    double const tail = 1 - confidence;
    std::vector<double> ends;
    for (int i = 0; i <= equal_parts; ++i) ends.push_back(static_cast<double>(i) / equal_parts);
    for (int i = 1; i <= 2 * parts_of_a_tail; ++i) {
        double const share = tail * i / parts_of_a_tail;
        if (share >= 0.5) break;
        ends.insert(ends.end(), {share, 1 - share});
    }
    std::ranges::sort(ends);
    auto const is_same = [](double a, double b) { return b - a < 1e-9; };
    ends.erase(std::unique(ends.begin(), ends.end(), is_same), ends.end());
    return ends;
}

}  // namespace vibrotrough::learn
