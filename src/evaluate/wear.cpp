#include "evaluate/wear.hpp"

#include "core/error.hpp"
#include "measure/open_flow.hpp"
#include "measure/wear.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::evaluate {
namespace {

/// What the trough had worn until the end of a cycle.
measure::WearSnapshot wear_until(int cycle, store::PackingRecord const& record, PackingFiles const& files) {
    std::string const name = measure::wear_file(static_cast<long>(cycle) * record.steps_per_cycle);
    auto const file = std::ranges::find_if(
        files.snapshots, [&](core::TextFile const& one) { return one.path.filename() == name; });
    std::optional<measure::WearSnapshot> snapshot;
    if (file != files.snapshots.end()) snapshot = measure::parse_wear(*file);
    if (!snapshot)
        throw core::InputError(fmt::format("{} is {}; run its case again", (files.folder / name).string(),
                                           file == files.snapshots.end() ? "missing" : "incomplete"));
    return *std::move(snapshot);
}

/// kg m, mass times way in the cycles from one to another: in a periodic box the mass of the layer times its
/// way; through an open trough what left it times the length of the trough.
double conveyed(store::PackingRecord const& record, prepare::PreparedCase const& prepared, int from, int to) {
    scenario::Scenario const& s = prepared.scenario;
    if (prepared.domain.open) {
        auto const& left = record.series.open.left_mass;
        return std::accumulate(left.begin() + from + 1, left.begin() + to + 1, 0.0) * s.layer.length;
    }
    auto const& efficiency = record.efficiency;
    return std::accumulate(efficiency.begin() + from, efficiency.begin() + to, 0.0) * record.mass *
           prepared.velocity_scale / s.trough.frequency;
}

}  // namespace

void read_wear(store::PackingRecord& record, prepare::PreparedCase const& prepared,
               PackingFiles const& files) {
    if (!prepared.scenario.measure.wear) return;
    std::vector<measure::WearSnapshot> snapshots;
    for (int cycle = 0; cycle <= record.series.cycles(); ++cycle)
        snapshots.push_back(wear_until(cycle, record, files));
    record.wear = measure::wear_of(std::move(snapshots));
}

void measure_wear(store::PackingRecord& record, prepare::PreparedCase const& prepared) {
    if (record.wear.history.empty()) return;
    int const to = record.estimate.discarded + record.estimate.measured;
    int const full = prepared.domain.open ? measure::cycles_to_fill(record.series) : 0;
    int const from = std::max(record.estimate.discarded, full);
    if (to > from)
        measure::add_rates(record.wear, from, to, (to - from) / prepared.scenario.trough.frequency,
                           conveyed(record, prepared, from, to));
    record.wear.history.clear();
}

}  // namespace vibrotrough::evaluate
