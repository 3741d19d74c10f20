#include "measure/size_flows.hpp"

#include "measure/cycle_dump.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

/// The sum of something over all sizes.
template <typename Value>
double over_sizes(std::vector<SizeFlow> const& flows, Value const& value) {
    return std::accumulate(flows.begin(), flows.end(), 0.0,
                           [&](double sum, SizeFlow const& one) { return sum + value(one); });
}

void count_grains(std::vector<SizeFlow>& flows, std::vector<double> SizeFlow::*list,
                  std::vector<PassedGrain> const& grains) {
    for (PassedGrain const& grain : grains) {
        auto const flow = std::ranges::find_if(
            flows, [&](SizeFlow const& one) { return is_same_size(grain.size, one.diameter); });
        if (flow == flows.end()) continue;
        auto const cycle = static_cast<std::size_t>(grain.cycle);
        if (cycle < ((*flow).*list).size()) ++((*flow).*list)[cycle];
    }
}

/// What the engine counted of all sizes together, and what the sizes add up to.
struct Sums {
    char const* what;
    double counted, by_size;
    double allowed = 0;
};

std::vector<Sums> sums_of(CycleSeries const& series, std::vector<SizeFlow> const& flows, std::size_t cycle,
                          double largest) {
    constexpr double of_a_grain = 1e-6, of_rounding = 1e-12;
    OpenSeries const& open = series.open;
    auto const number = [&](std::vector<double> SizeFlow::*list) {
        return over_sizes(flows, [&](SizeFlow const& one) { return (one.*list)[cycle]; });
    };
    auto const mass = [&](std::vector<double> SizeFlow::*list) {
        return over_sizes(flows, [&](SizeFlow const& one) { return (one.*list)[cycle] * one.mass; });
    };
    double const allowed = of_a_grain * largest;
    return {{"grains left over the edge", open.left[cycle], number(&SizeFlow::left)},
            {"grains passed the screen", open.passed[cycle], number(&SizeFlow::passed)},
            {"grains are on the screen", open.held[cycle], number(&SizeFlow::held)},
            {"kg are on the screen", open.held_mass[cycle], mass(&SizeFlow::held), allowed},
            {"grains were fed", open.fed[cycle], number(&SizeFlow::fed)},
            {"kg were fed", open.fed_mass[cycle], mass(&SizeFlow::fed),
             allowed + of_rounding * open.fed_mass[cycle]}};
}

double sum_after(std::vector<double> const& values, int from, int to) {
    return std::accumulate(values.begin() + from + 1, values.begin() + to + 1, 0.0);
}

/// One row for each size and cycle.
void add_rows(SizeTable& table, std::vector<SizeFlow> const& flows) {
    for (SizeFlow const& one : flows) {
        for (std::size_t k = 0; k < one.held.size(); ++k) {
            table.diameter.push_back(one.diameter);
            table.cycle.push_back(static_cast<double>(k));
            table.fed.push_back(one.fed[k]);
            table.held.push_back(one.held[k]);
            table.left.push_back(one.left[k]);
            table.passed.push_back(one.passed[k]);
        }
    }
}

}  // namespace

std::vector<PassedGrain> parse_left_sizes(std::vector<core::TextFile> const& files, int steps_per_cycle) {
    std::vector<PassedGrain> left;
    std::set<long> known;
    for (DumpedGrain const& grain : parse_cycle_dumps(files, "left", "id x vx radius", steps_per_cycle)) {
        auto const id = static_cast<long>(grain.values[0]);
        if (known.insert(id).second) left.push_back({grain.cycle, id, 2 * grain.values[3]});
    }
    return left;
}

std::vector<SizeFlow> size_flows(CycleSeries const& series, std::vector<PassedGrain> const& left,
                                 std::vector<PassedGrain> const& passed,
                                 std::vector<ScreenedSize> const& sizes) {
    auto const ends = static_cast<std::size_t>(series.cycles()) + 1;
    std::vector<SizeFlow> flows;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        std::vector<double> const none(ends);
        flows.push_back({sizes[i].diameter, sizes[i].mass, series.open.of_size[i], none, none, none});
    }
    count_grains(flows, &SizeFlow::left, left);
    count_grains(flows, &SizeFlow::passed, passed);
    for (SizeFlow& one : flows) {
        double gone = 0;
        for (std::size_t k = 0; k < ends; ++k) {
            gone += one.left[k] + one.passed[k];
            one.held[k] -= one.left[k] + one.passed[k];
            one.fed[k] = one.held[k] - one.held[0] + gone;
        }
    }
    std::ranges::sort(flows, {}, &SizeFlow::diameter);
    return flows;
}

std::optional<std::string> flow_imbalance(CycleSeries const& series, std::vector<SizeFlow> const& flows) {
    double const largest = flows.back().mass;
    for (std::size_t k = 0; k < series.open.held.size(); ++k) {
        for (Sums const& sum : sums_of(series, flows, k, largest)) {
            if (std::abs(sum.counted - sum.by_size) <= sum.allowed) continue;
            return fmt::format("at the end of cycle {} {:.9g} {} by the engine's count, and {:.9g} by sizes",
                               k, sum.counted, sum.what, sum.by_size);
        }
        for (SizeFlow const& one : flows) {
            if (k == 0 || one.fed[k] >= one.fed[k - 1]) continue;
            return fmt::format("{:g} grains of {:.6g} mm are missing at the end of cycle {}",
                               one.fed[k - 1] - one.fed[k], 1e3 * one.diameter, k);
        }
    }
    return {};
}

Screening screening_of_flows(std::vector<SizeFlow> const& flows, double opening, int from, int to,
                             double period) {
    Screening s;
    add_rows(s.by_size, flows);
    double under = 0, under_passed = 0, all_left = 0, all_passed = 0;
    std::vector<double> known, shares;
    for (SizeFlow const& one : flows) {
        double const left = sum_after(one.left, from, to), passed = sum_after(one.passed, from, to);
        s.diameter.push_back(one.diameter);
        s.mass.push_back(one.mass);
        s.number.push_back(left + passed);
        s.passed.push_back(passed);
        all_left += left * one.mass;
        all_passed += passed * one.mass;
        if (left + passed > 0) {
            known.push_back(one.diameter);
            shares.push_back(left / (left + passed));
        }
        if (one.diameter >= opening) continue;
        under += (left + passed) * one.mass;
        under_passed += passed * one.mass;
    }
    if (to > from) s.underflow = all_passed / ((to - from) * period);
    if (under > 0) s.efficiency = under_passed / under;
    if (all_left + all_passed > 0) s.passed_share = all_passed / (all_left + all_passed);
    if (all_left > 0) s.undersize = (under - under_passed) / all_left;
    s.cut_size = cut_size(known, shares, opening);
    return s;
}

}  // namespace vibrotrough::measure
