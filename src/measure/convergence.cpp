#include "measure/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vibrotrough::measure {
namespace {

/// Intervals are not taken to be narrower than this: a weight of an exact value would be infinite.
constexpr double narrowest = 1e-12;

bool is_monotonic(std::span<RefinedMean const> means) {
    auto const rises = [](RefinedMean const& a, RefinedMean const& b) { return b.mean <= a.mean; };
    auto const falls = [](RefinedMean const& a, RefinedMean const& b) { return b.mean >= a.mean; };
    return std::ranges::adjacent_find(means, rises) == means.end() ||
           std::ranges::adjacent_find(means, falls) == means.end();
}

/// A straight line through weighted points.
struct Line {
    double offset, slope;
    double slope_half_width;
};

Line fit(std::span<RefinedMean const> means, double order) {
    double sum = 0, x_sum = 0, y_sum = 0;
    auto const weight = [](RefinedMean const& one) {
        return 1 / std::pow(std::max(one.half_width, narrowest), 2);
    };
    for (RefinedMean const& one : means) {
        sum += weight(one);
        x_sum += weight(one) * std::pow(one.coarseness, order);
        y_sum += weight(one) * one.mean;
    }
    double const x_mean = x_sum / sum, y_mean = y_sum / sum;
    double xx = 0, xy = 0;
    for (RefinedMean const& one : means) {
        double const x = std::pow(one.coarseness, order) - x_mean;
        xx += weight(one) * x * x;
        xy += weight(one) * x * (one.mean - y_mean);
    }
    double const slope = xy / xx;
    return {y_mean - slope * x_mean, slope, 1 / std::sqrt(xx)};
}

bool goes_through(Line const& line, std::span<RefinedMean const> means, double order) {
    return std::ranges::all_of(means, [&](RefinedMean const& one) {
        double const on_line = line.offset + line.slope * std::pow(one.coarseness, order);
        return std::abs(one.mean - on_line) <= std::max(one.half_width, narrowest);
    });
}

}  // namespace

double NumericalError::bound() const {
    return std::max(half_width, std::abs(error) + 0.84 * half_width);
}

NumericalError with_expected(NumericalError const& measured, double expected) {
    double const both = std::hypot(measured.half_width, expected);
    if (std::isinf(expected) || both == 0 || std::abs(measured.error) > both) return measured;
    double const weight = std::pow(expected / both, 2);
    return {measured.verdict, weight * measured.error, measured.half_width * expected / both};
}

NumericalError difference(RefinedMean const& a, RefinedMean const& b) {
    double const error = a.mean - b.mean, half_width = std::hypot(a.half_width, b.half_width);
    bool const significant = std::abs(error) > half_width;
    return {significant ? Convergence::resolved : Convergence::not_resolved, error, half_width};
}

NumericalError numerical_error(std::span<RefinedMean const> means, std::optional<double> order) {
    if (means.size() < 2) throw std::invalid_argument("a numerical error needs two means");
    NumericalError const found = difference(means.front(), means.back());
    if (found.verdict == Convergence::not_resolved || !order || means.size() < 3 || !is_monotonic(means))
        return found;
    Line const line = fit(means, *order);
    if (!goes_through(line, means, *order)) return found;
    return {Convergence::extrapolated, line.slope, line.slope_half_width};
}

}  // namespace vibrotrough::measure
