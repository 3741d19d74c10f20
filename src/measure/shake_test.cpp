#include "measure/shake_test.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vibrotrough::measure {
namespace {

constexpr std::size_t lines = PhaseSeries::per_cycle;

void check(PhaseSeries const& series, int first, int last) {
    if (first < 1 || last <= first || last > series.cycles())
        throw std::invalid_argument("the series does not contain these cycles");
}

double relative_displacement(PhaseSeries const& series, std::size_t line) {
    return series.x[line] - series.trough_x[line];
}

/// How far the extremum of the parabola through three positions lies beyond the middle one, which is the
/// outermost.
double overshoot(double before, double middle, double after) {
    double const curvature = before - 2 * middle + after;
    return curvature == 0 ? 0 : -(after - before) * (after - before) / (8 * curvature);
}

}  // namespace

std::vector<double> relative_displacement_ranges(PhaseSeries const& series, int first, int last) {
    check(series, first, last);
    std::vector<double> ranges;
    for (int cycle = first; cycle < last; ++cycle) {
        std::size_t const begin = static_cast<std::size_t>(cycle) * lines - 1;
        std::size_t least = begin, most = begin;
        for (std::size_t i = begin; i <= begin + lines; ++i) {
            if (relative_displacement(series, i) < relative_displacement(series, least)) least = i;
            if (relative_displacement(series, i) > relative_displacement(series, most)) most = i;
        }
        auto const turning = [&](std::size_t i) {
            double const position = relative_displacement(series, i);
            // The first and the last line of the cycle do not have two neighbours for a parabola.
            if (i == begin || i == begin + lines) return position;
            return position + overshoot(relative_displacement(series, i - 1), position,
                                        relative_displacement(series, i + 1));
        };
        ranges.push_back(turning(most) - turning(least));
    }
    return ranges;
}

double creep_per_cycle(PhaseSeries const& series, int first, int last) {
    check(series, first, last);
    std::size_t const begin = static_cast<std::size_t>(first) * lines - 1;
    std::size_t const end = static_cast<std::size_t>(last) * lines - 1;
    return (relative_displacement(series, end) - relative_displacement(series, begin)) / (last - first);
}

}  // namespace vibrotrough::measure
