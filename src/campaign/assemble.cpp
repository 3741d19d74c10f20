#include "campaign/assemble.hpp"

#include "campaign/case_state.hpp"
#include "campaign/layer.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

std::vector<double> efficiency_of(Scenario const& scenario, measure::CycleSeries const& series) {
    Trough const& trough = scenario.trough;
    // The engine does not unwrap the positions of rigid bodies.
    if (is_clump(scenario.grains) || scenario.layer.block == Block::plate)
        return measure::velocity_efficiency_by_mean(series, velocity_scale(trough));
    return measure::velocity_efficiency(series, trough.amplitude * std::cos(trough.vibration_angle));
}

measure::Precision wanted(Scenario const& scenario) {
    return {scenario.measure.confidence, scenario.measure.half_width};
}

std::string outcome_of(std::vector<measure::PackingEstimate> const& packings) {
    auto const any = [&](measure::Verdict verdict) {
        return std::ranges::any_of(packings, [&](auto const& packing) { return packing.verdict == verdict; });
    };
    if (any(measure::Verdict::not_steady)) return "not-steady";
    if (any(measure::Verdict::not_precise)) return "not-precise";
    return "finished";
}

store::PackingRecord read_packing(PlannedCase const& planned, int packing, FinishedPacking const& marker) {
    deck::Deck const deck = deck::make_deck(planned.scenario, packing);
    auto const folder = planned.packing_folder(packing);
    auto const all =
        measure::read_cycles(folder / "cycles.csv", deck.time.steps_per_cycle, planned.scenario.layer.grains);
    auto const answer = estimate_series(planned.scenario, all);
    store::PackingRecord record{};
    record.seed = deck.seed;
    record.steps_per_cycle = deck.time.steps_per_cycle;
    record.time_step = deck.time.time_step;
    record.mass = deck.mass;
    record.wall_time = marker.wall_time;
    record.series = measure::first_cycles(all, answer.used);
    record.efficiency = efficiency_of(planned.scenario, record.series);
    record.estimate = answer.estimate;
    record.deck = read_file(folder / "in.liggghts");
    measure_layer(record, planned.scenario, deck, folder);
    return record;
}

}  // namespace

measure::SequentialEstimate estimate_series(Scenario const& scenario, measure::CycleSeries const& series) {
    return measure::estimate_sequentially(efficiency_of(scenario, series), wanted(scenario));
}

bool enough_cycles(Scenario const& scenario, measure::CycleSeries const& series) {
    return measure::cycles_needed(efficiency_of(scenario, series), wanted(scenario)).has_value();
}

store::CaseRecord assemble(PlannedCase const& planned, std::string const& engine_version) {
    store::CaseRecord record{};
    record.id = planned.id;
    record.scenario = planned.scenario;
    record.scenario_toml = to_toml(planned.scenario);
    std::vector<measure::PackingEstimate> estimates;
    for (int packing = 1; packing <= planned.scenario.measure.packings; ++packing) {
        auto const marker = read_finished_packing(planned, packing);
        if (!marker)
            throw InputError(fmt::format("packing {} of case {} is not finished", packing, planned.id));
        record.packings.push_back(read_packing(planned, packing, *marker));
        estimates.push_back(record.packings.back().estimate);
        auto& [version, commit, engine, certificate, host, started, finished] = record.provenance;
        if (packing == 1) {
            record.provenance = {marker->program_version,
                                 marker->git_commit,
                                 engine_version,
                                 marker->engine_certificate,
                                 marker->host,
                                 marker->started,
                                 marker->finished};
        }
        started = std::min(started, marker->started);  // ISO 8601 sorts as text
        finished = std::max(finished, marker->finished);
    }
    record.estimate = measure::combine(estimates, planned.scenario.measure.confidence);
    record.outcome = outcome_of(estimates);
    record.layer_mode = common_mode(record.packings);
    if (record.outcome == "not-steady") {
        // The mean of what is no steady state is no number; the cycles stay in the record.
        record.estimate.mean = record.estimate.half_width = std::numeric_limits<double>::quiet_NaN();
    }
    return record;
}

}  // namespace vibrotrough::campaign
