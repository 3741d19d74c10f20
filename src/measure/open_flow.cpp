#include "measure/open_flow.hpp"

#include "core/error.hpp"
#include "measure/cycle_dump.hpp"
#include "measure/estimate.hpp"
#include "measure/layer_profiles.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include <boost/math/tools/roots.hpp>
#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

double mean_of(std::vector<double> const& values, int from, int to) {
    return std::accumulate(values.begin() + from, values.begin() + to, 0.0) / (to - from);
}

/// The grains that left in the cycles that count.
std::vector<LeftGrain> counted(std::vector<LeftGrain> const& left, OpenFacts const& facts) {
    std::vector<LeftGrain> found;
    std::ranges::copy_if(left, std::back_inserter(found), [&](LeftGrain const& grain) {
        return grain.cycle > facts.discarded && grain.cycle <= facts.used;
    });
    return found;
}

/// s, from a part of a cycle until the end of a cycle.
double elapsed(OpenFacts const& facts, double cycle, double share, int end) {
    if (facts.ends.empty()) return (end - cycle + 1 - share) * facts.period;
    auto const number = static_cast<std::size_t>(cycle);
    double const start = facts.ends[number - 1], duration = facts.ends[number] - start;
    return facts.ends[static_cast<std::size_t>(end)] - start - share * duration;
}

/// From when each grain was fed until it passed the edge. The numbers of the grains follow the order in
/// which they were fed, evenly within a cycle; behind the edge they fly with a steady speed.
std::vector<Stay> stays_of(CycleSeries const& series, std::vector<LeftGrain> const& left,
                           OpenFacts const& facts) {
    std::vector<double> const& fed = series.open.fed;
    double const first = series.open.held.front();  // grains that were there before the drive
    std::vector<Stay> stays;
    for (LeftGrain const& grain : left) {
        double const number = static_cast<double>(grain.id) - first;
        if (number < 1) continue;
        auto const after = std::ranges::lower_bound(fed, number);
        if (after == fed.begin() || after - fed.begin() > grain.cycle)
            throw core::InputError(
                fmt::format("grain {} left in cycle {}, before it was fed", grain.id, grain.cycle));
        auto const cycle = static_cast<double>(after - fed.begin());
        double const before = *(after - 1), share = (number - 0.5 - before) / (*after - before);
        auto const last = static_cast<std::size_t>(grain.cycle);
        double const duration = facts.ends.empty() ? facts.period : facts.ends[last] - facts.ends[last - 1];
        double const flown = grain.vx > 0 ? std::clamp((grain.x - facts.edge) / grain.vx, 0.0, duration) : 0;
        stays.push_back({elapsed(facts, cycle, share, grain.cycle) - flown, grain.type});
    }
    return stays;
}

void add_residence(OpenFlow& flow, std::vector<Stay> const& stays) {
    constexpr std::size_t parts = 100;
    if (stays.size() < fewest_stays) return;
    std::vector<double> times;
    for (Stay const& stay : stays) times.push_back(stay.time);
    std::ranges::sort(times);
    auto const count = static_cast<double>(times.size());
    double const mean = std::accumulate(times.begin(), times.end(), 0.0) / count;
    double squares = 0;
    for (double const time : times) squares += (time - mean) * (time - mean);
    flow.residence_time = mean;
    flow.residence_spread = std::sqrt(squares / (count - 1));
    flow.peclet = peclet_number(squares / (count - 1) / (mean * mean));
    for (std::size_t i = 0; i <= parts; ++i) flow.residence.push_back(times[i * (times.size() - 1) / parts]);
}

/// The bins of the trough at the times that count.
std::vector<Snapshot> on_trough(std::vector<Snapshot> snapshots, OpenFacts const& facts) {
    std::erase_if(snapshots, [&](Snapshot const& one) {
        return one.step <= static_cast<long>(facts.discarded) * facts.steps_per_cycle ||
               one.step > static_cast<long>(facts.used) * facts.steps_per_cycle;
    });
    for (Snapshot& one : snapshots)
        std::erase_if(one.bins, [&](Bin const& bin) {
            return bin.position < 0 || bin.position > facts.edge || bin.means.empty();
        });
    return snapshots;
}

AlongTrough along_trough(std::vector<Snapshot> const& snapshots, OpenFacts const& facts) {
    AlongTrough along;
    if (snapshots.empty()) return along;
    auto const count = static_cast<double>(snapshots.size());
    for (std::size_t place = 0; place < snapshots.front().bins.size(); ++place) {
        double depth = 0, speed = 0, grains = 0;
        for (Snapshot const& one : snapshots) {
            Bin const& bin = one.bins.at(place);
            depth += bin.density * facts.box_section / (facts.bulk_density * facts.width);
            speed += bin.grains * bin.means[0];
            grains += bin.grains;
        }
        along.x.push_back(snapshots.front().bins[place].position);
        along.depth.push_back(depth / count);
        along.speed.push_back(grains > 0 ? speed / grains : std::numeric_limits<double>::quiet_NaN());
        if (facts.level) along.level.push_back(facts.level(along.x.back(), along.depth.back()));
    }
    return along;
}

/// s, until the trough first holds 95 % of its later mass, between the ends of two cycles.
std::optional<double> fill_time(std::vector<double> const& held, double hold_up, double period) {
    double const wanted = 0.95 * hold_up;
    for (std::size_t k = 1; k < held.size(); ++k) {
        if (held[k] < wanted) continue;
        double const gain = held[k] - held[k - 1];
        double const share = gain > 0 ? (wanted - held[k - 1]) / gain : 1;
        return (static_cast<double>(k) - 1 + std::clamp(share, 0.0, 1.0)) * period;
    }
    return {};
}

}  // namespace

std::vector<LeftGrain> parse_left(std::vector<core::TextFile> const& files, int steps_per_cycle,
                                  bool is_mixture) {
    std::vector<LeftGrain> left;
    char const* const columns = is_mixture ? "id x vx type mass" : "id x vx";
    for (DumpedGrain const& grain : parse_cycle_dumps(files, "left", columns, steps_per_cycle))
        left.push_back({grain.cycle, static_cast<long>(grain.values[0]), grain.values[1], grain.values[2],
                        static_cast<int>(grain.values[3]), grain.values[4]});
    return left;
}

std::optional<std::string> imbalance(CycleSeries const& series) {
    constexpr double rounding = 1e-9;  // of the mass; the engine's sums agree to 1e-15
    OpenSeries const& open = series.open;
    double left = 0, left_mass = 0;
    for (std::size_t k = 1; k < open.held.size(); ++k) {
        left += open.left[k] + (open.passed.empty() ? 0 : open.passed[k]);
        left_mass += open.left_mass[k] + (open.passed_mass.empty() ? 0 : open.passed_mass[k]);
        double const lost = open.held[0] + open.fed[k] - open.held[k] - left;
        double const lost_mass = open.held_mass[0] + open.fed_mass[k] - open.held_mass[k] - left_mass;
        bool const is_whole =
            lost == 0 && std::abs(lost_mass) <= rounding * (open.held_mass[0] + open.fed_mass[k]);
        if (is_whole) continue;
        return fmt::format(
            "{:g} grains of {:.3g} kg are missing at the end of cycle {}: {:g} were there at first, {:g} "
            "were fed, {:g} "
            "are in the trough and {:g} have left it",
            lost, lost_mass, k, open.held[0], open.fed[k], open.held[k], left);
    }
    return {};
}

int cycles_to_fill(CycleSeries const& series) {
    std::vector<double> const& held = series.open.held_mass;
    return startup_length(std::span(held).subspan(1));
}

std::optional<double> peclet_number(double relative_variance) {
    if (!(relative_variance > 0 && relative_variance < 1)) return {};
    auto const excess = [&](double log_peclet) {
        double const pe = std::exp(log_peclet);
        // The difference cancels for small numbers, where s = 1 - Pe/3.
        double const variance = pe < 1e-3 ? 1 - pe / 3 : 2 / pe + 2 / (pe * pe) * std::expm1(-pe);
        return variance - relative_variance;
    };
    double low = -14, high = 30;
    if (excess(low) < 0 || excess(high) > 0) return {};
    auto const [a, b] =
        boost::math::tools::bisect(excess, low, high, boost::math::tools::eps_tolerance<double>(40));
    return std::exp((a + b) / 2);
}

OpenFlow open_flow(CycleSeries const& series, std::vector<LeftGrain> const& left,
                   std::vector<core::TextFile> const& files, std::filesystem::path const& folder,
                   OpenFacts const& facts) {
    OpenFlow flow;
    int const from = facts.discarded, to = facts.used;
    if (to <= from) return flow;
    OpenSeries const& open = series.open;
    bool const is_steady = facts.ends.empty();
    double const time =
        is_steady ? (to - from) * facts.period
                  : facts.ends[static_cast<std::size_t>(to)] - facts.ends[static_cast<std::size_t>(from)];
    auto const at = [](std::vector<double> const& values, int k) {
        return values[static_cast<std::size_t>(k)];
    };
    flow.inflow = (at(open.fed_mass, to) - at(open.fed_mass, from)) / time;
    double const left_per_cycle = mean_of(open.left_mass, from + 1, to + 1);
    flow.outflow = is_steady ? left_per_cycle / facts.period : left_per_cycle * (to - from) / time;
    auto const mean_over_time = [&](std::vector<double> const& values) {
        if (is_steady) return mean_of(values, from + 1, to + 1);
        double sum = 0;
        for (int k = from + 1; k <= to; ++k)
            sum += at(values, k) *
                   (facts.ends[static_cast<std::size_t>(k)] - facts.ends[static_cast<std::size_t>(k) - 1]);
        return sum / time;
    };
    flow.hold_up = mean_over_time(open.held_mass);
    flow.window_depth = mean_over_time(open.window_mass) / (facts.bulk_density * facts.window * facts.width);
    if (is_steady) flow.fill_time = fill_time(open.held_mass, *flow.hold_up, facts.period);
    std::vector<LeftGrain> const gone = counted(left, facts);
    std::vector<Stay> const stays = stays_of(series, gone, facts);
    add_residence(flow, stays);
    if (!is_steady) flow.peclet.reset();  // its equation is that of a steady stream
    std::vector<Snapshot> const snapshots = on_trough(parse_snapshots(files, folder, "along"), facts);
    flow.along = along_trough(snapshots, facts);
    if (facts.mixture.types.empty()) return flow;
    flow.materials_along = materials_along(snapshots, facts.mixture, flow.along.depth);
    flow.materials = material_flows(flow.materials_along, flow.along.depth, gone, stays, time, facts.mixture);
    return flow;
}

}  // namespace vibrotrough::measure
