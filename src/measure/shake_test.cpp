#include "measure/shake_test.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vibrotrough::measure {
namespace {

constexpr std::size_t lines = PhaseSeries::per_cycle;

void check(PhaseSeries const& series, int first, int last) {
    if (first < 1 || last <= first || last > series.cycles())
        throw std::invalid_argument("no such cycles in the series");
}

double away(PhaseSeries const& series, std::size_t line) {
    return series.x[line] - series.trough_x[line];
}

/// How far the parabola through three places goes beyond the middle one, which is the outermost.
double beyond(double before, double middle, double after) {
    double const bend = before - 2 * middle + after;
    return bend == 0 ? 0 : -(after - before) * (after - before) / (8 * bend);
}

}  // namespace

std::vector<double> pen_lines(PhaseSeries const& series, int first, int last) {
    check(series, first, last);
    std::vector<double> drawn;
    for (int cycle = first; cycle < last; ++cycle) {
        std::size_t const begin = static_cast<std::size_t>(cycle) * lines - 1;
        std::size_t least = begin, most = begin;
        for (std::size_t i = begin; i <= begin + lines; ++i) {
            if (away(series, i) < away(series, least)) least = i;
            if (away(series, i) > away(series, most)) most = i;
        }
        auto const turning = [&](std::size_t i) {
            double const place = away(series, i);
            // At the ends of the line there is no turning point to be seen.
            if (i == begin || i == begin + lines) return place;
            return place + beyond(away(series, i - 1), place, away(series, i + 1));
        };
        drawn.push_back(turning(most) - turning(least));
    }
    return drawn;
}

double creep_per_cycle(PhaseSeries const& series, int first, int last) {
    check(series, first, last);
    std::size_t const begin = static_cast<std::size_t>(first) * lines - 1;
    std::size_t const end = static_cast<std::size_t>(last) * lines - 1;
    return (away(series, end) - away(series, begin)) / (last - first);
}

}  // namespace vibrotrough::measure
