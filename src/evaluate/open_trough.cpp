#include "evaluate/open_trough.hpp"

#include "deck/atom_types.hpp"
#include "measure/mass_flow.hpp"
#include "measure/open_flow.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::evaluate {

void measure_open(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                  PackingFiles const& files) {
    scenario::Scenario const& s = prepared.scenario;
    prepare::OpenTrough const& open = *prepared.domain.open;
    measure::OpenFacts facts{1 / s.trough.frequency,
                             s.layer.length,
                             record.steps_per_cycle,
                             std::max(record.estimate.discarded, measure::cycles_to_fill(record.series)),
                             record.series.cycles(),
                             scenario::settled_solid_fraction * mean_density(s),
                             s.layer.width,
                             open.window_end - open.window_start,
                             (s.layer.width + 2 * open.box_side) * (prepared.box_top - prepared.box_bottom)};
    if (!prepared.stages.empty()) {  // all cycles count, as nothing is steady
        facts.discarded = 0;
        facts.ends = {0};
        for (double const duration : cycle_durations(prepared.stages))
            facts.ends.push_back(facts.ends.back() + duration);
    }
    if (s.trough.mesh)
        facts.level = [mesh = s.trough.mesh, half = open.bin / 2, unit = metres_in(s.trough.mesh_unit)](
                          double x, double mean_depth) {
            return unit * mesh->level_across(mean_depth / unit, (x - half) / unit, (x + half) / unit).height;
        };
    bool const is_mixture = prepared.materials.size() > 1;
    if (is_mixture) {
        facts.mixture.window_start = open.window_start;
        facts.mixture.window_end = open.window_end;
        for (int i = 0; i < static_cast<int>(prepared.materials.size()); ++i)
            facts.mixture.types.push_back(deck::atom_type_of(prepared, i));
    }
    record.open = measure::open_flow(record.series,
                                     measure::parse_left(files.snapshots, record.steps_per_cycle, is_mixture),
                                     files.snapshots, files.folder, facts);
}

std::string unsteady_flow(store::CaseRecord const& record) {
    constexpr double tolerance = 0.02;
    if (!record.scenario.stages.empty()) return {};
    std::vector<double> differences;
    for (store::PackingRecord const& packing : record.packings) {
        if (packing.open.inflow && *packing.open.inflow > 0)
            differences.push_back(
                (*packing.open.outflow + packing.screening.underflow.value_or(0)) / *packing.open.inflow - 1);
    }
    if (differences.empty()) return {};
    double mean = 0;
    for (double const one : differences) mean += one / static_cast<double>(differences.size());
    std::vector<double> const& fed = record.packings.front().series.open.fed;
    // One packing has no interval: the numbers of grains fluctuate by their roots at most.
    double const by_counting = 2 / std::sqrt(fed.empty() ? 1 : std::max(1.0, fed.back()));
    double const half_width =
        measure::student_half_width(differences, record.scenario.measure.confidence).value_or(by_counting);
    if (std::abs(mean) <= tolerance + half_width) return {};
    return fmt::format(
        "the outflow is {:.3g} % {} than the inflow: the trough is not full yet, or is overfed",
        100 * std::abs(mean), mean < 0 ? "less" : "more");
}

}  // namespace vibrotrough::evaluate
