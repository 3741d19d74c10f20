#include "campaign/measured_packing.hpp"

#include "campaign/layer.hpp"

#include <cmath>

namespace vibrotrough::campaign {
namespace {

std::vector<double> efficiency_of(scenario::Scenario const& scenario, measure::CycleSeries const& series) {
    scenario::Trough const& trough = scenario.trough;
    // The engine does not unwrap the positions of rigid bodies.
    if (is_clump(scenario.grains) || scenario.layer.block == scenario::Block::plate)
        return measure::velocity_efficiency_by_mean(series, velocity_scale(trough));
    return measure::velocity_efficiency(series, trough.amplitude * std::cos(trough.vibration_angle));
}

measure::Precision wanted(scenario::Scenario const& scenario) {
    return {scenario.measure.confidence, scenario.measure.half_width};
}

}  // namespace

measure::SequentialEstimate estimate_series(scenario::Scenario const& scenario,
                                            measure::CycleSeries const& series) {
    return measure::estimate_sequentially(efficiency_of(scenario, series), wanted(scenario));
}

bool enough_cycles(scenario::Scenario const& scenario, measure::CycleSeries const& series) {
    return measure::cycles_needed(efficiency_of(scenario, series), wanted(scenario)).has_value();
}

store::PackingRecord measure_packing(scenario::Scenario const& scenario, deck::Deck const& deck,
                                     PackingOutputs const& outputs, measure::CycleSeries const& all,
                                     measure::PhaseSeries const& phases) {
    auto const answer = estimate_series(scenario, all);
    store::PackingRecord record{};
    record.seed = deck.seed;
    record.steps_per_cycle = deck.time.steps_per_cycle;
    record.time_step = deck.time.time_step;
    record.mass = deck.mass;
    record.series = measure::first_cycles(all, answer.used);
    record.efficiency = efficiency_of(scenario, record.series);
    record.estimate = answer.estimate;
    record.deck = deck.files.at(deck::drive_file);
    measure_layer(record, scenario, deck, outputs, phases);
    return record;
}

std::optional<MeasuredPacking> read_measured_packing(PlannedCase const& planned, int packing) {
    auto const outputs = read_outputs(planned.packing_folder(packing));
    auto const run = read_finished_packing(planned, packing, outputs);
    if (!run) return {};
    scenario::Scenario const& scenario = planned.scenario;
    deck::Deck const deck = deck::make_deck(scenario, packing);
    auto const all = measure::parse_cycles(outputs.cycles, deck.time.steps_per_cycle, scenario.layer.grains);
    auto const phases = packing_phases(scenario, deck, outputs.phases);
    MeasuredPacking measured{*run, measure_packing(scenario, deck, outputs, all, phases)};
    measured.record.wall_time = run->wall_time;
    measured.record.deck = core::read_file(planned.packing_folder(packing) / deck::drive_file);
    return measured;
}

}  // namespace vibrotrough::campaign
