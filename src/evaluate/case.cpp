#include "evaluate/case.hpp"

#include "evaluate/layer.hpp"
#include "evaluate/open_trough.hpp"
#include "measure/mass_flow.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "store/material_quantities.hpp"
#include "store/stage_quantities.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::evaluate {
measure::Start start_of(int packing) {
    return packing % 2 == 1 ? measure::Start::below : measure::Start::above;
}

core::Outcome outcome_of(measure::CaseEstimate const& estimate, scenario::Scenario const& scenario) {
    if (has_given_length(scenario)) return core::Outcome::finished;
    if (estimate.steadiness == measure::Steadiness::branching) return core::Outcome::bistable_or_slow;
    if (estimate.steadiness == measure::Steadiness::drifting) return core::Outcome::not_steady;
    bool const is_enough = estimate.half_width && prepare::is_narrow_enough(*estimate.half_width, scenario);
    return is_enough ? core::Outcome::finished : core::Outcome::not_precise;
}

measure::CaseEstimate estimate_of(std::vector<measure::PackingValues> const& packings,
                                  scenario::Scenario const& scenario) {
    if (!has_given_length(scenario)) return measure::estimate_case(packings, wanted_statistics(scenario));
    std::vector<double> durations = cycle_durations(stages(scenario));
    if (durations.empty()) durations.assign(static_cast<std::size_t>(scenario.measure.max_cycles), 1);
    std::vector<double> means;
    for (measure::PackingValues const& packing : packings) {
        double sum = 0, time = 0;
        for (std::size_t i = 0; i < packing.values.size(); ++i) {
            if (is_screen(scenario) && packing.values[i] == 0) continue;  // nothing was on it any more
            sum += packing.values[i] * durations[i];
            time += durations[i];
        }
        means.push_back(sum / time);
    }
    measure::CaseEstimate estimate{};
    estimate.packings = static_cast<int>(packings.size());
    estimate.measured = static_cast<int>(packings.front().values.size());
    estimate.mean = std::accumulate(means.begin(), means.end(), 0.0) / static_cast<double>(means.size());
    estimate.half_width = measure::student_half_width(means, scenario.measure.confidence);
    return estimate;
}

measure::Precision wanted_statistics(scenario::Scenario const& scenario) {
    scenario::MeasurementPlan const plan = prepare::statistics_plan(scenario);
    return {plan.confidence, plan.half_width};
}

namespace {

/// Of the first packing, from the start of the earliest to the end of the latest.
store::Provenance provenance_of(EvaluatedPackings const& packings, std::string const& engine_version) {
    PackingMarker const& first = packings.begin()->second.run;
    store::Provenance provenance{
        first.program_version, first.git_commit, engine_version, first.engine_certificate, first.host,
        first.started,         first.finished};
    for (auto const& [number, packing] : packings) {
        provenance.started = std::min(provenance.started, packing.run.started);  // ISO 8601 sorts as text
        provenance.finished = std::max(provenance.finished, packing.run.finished);
    }
    return provenance;
}

/// The estimate of the case, and of its packings with the start-up that they have in common.
void add_estimate(store::CaseRecord& record) {
    measure::Precision const wanted = wanted_statistics(record.scenario);
    std::vector<measure::PackingValues> values;
    for (store::PackingRecord const& packing : record.packings)
        values.push_back({packing.efficiency, start_of(static_cast<int>(values.size()) + 1)});
    record.estimate = estimate_of(values, record.scenario);
    for (store::PackingRecord& packing : record.packings) {
        packing.estimate =
            measure::estimate_packing_after(record.estimate.discarded, packing.efficiency, wanted);
    }
    store::add_materials(record);
    store::add_stages(record);
    record.outcome = outcome_of(record.estimate, record.scenario);
    if (!unsteady_flow(record).empty()) record.outcome = core::Outcome::not_steady;
    if (has_mean(record.outcome)) return;
    // No mean is reported unless the case is steady; the cycles stay in the record.
    record.estimate.mean.reset();
    record.estimate.half_width.reset();
}

std::string in_words(std::optional<measure::Branch> const& branch) {
    if (!branch) return "unknown";
    if (!branch->half_width) return fmt::format("{:.3f}", branch->mean);
    return fmt::format("{:.3f} +- {:.3f}", branch->mean, *branch->half_width);
}

std::string what_numerics_would_take(scenario::Scenario const& s) {
    prepare::NumericalErrors const numerics = prepare::numerical_errors(s);
    return fmt::format(
        "the numerical errors alone may be {:.3f} (soft grains {:.3f}, box {:.3f}, time step {:.3f}), which "
        "is too much for a half-width of {:g}, and more packings do not help: {}",
        numerics.total(), numerics.softness, numerics.box, numerics.time_step, s.measure.half_width,
        prepare::how_to_lower(numerics));
}

std::string what_statistics_would_take(store::CaseRecord const& record) {
    auto const needed = measure::packings_needed(record.estimate, wanted_statistics(record.scenario));
    auto const packings = static_cast<int>(record.packings.size());
    if (!needed || *needed <= packings) return "needs longer or more packings";
    double core_time = 0;
    for (store::PackingRecord const& packing : record.packings) core_time += packing.core_time;
    return fmt::format("needs about {} packings, {} more than it has, which take {:.2g} core-hours", *needed,
                       *needed - packings, core_time / packings * (*needed - packings) / 3600);
}

std::string what_it_would_take(store::CaseRecord const& record) {
    scenario::Scenario const& s = record.scenario;
    if (prepare::can_be_finished(s)) return what_statistics_would_take(record);
    if (measure::is_precise(record.estimate, wanted_statistics(s))) return what_numerics_would_take(s);
    return what_statistics_would_take(record) + "; besides, " + what_numerics_would_take(s);
}

}  // namespace

std::string remark_on(store::CaseRecord const& record) {
    if (std::string flow = unsteady_flow(record); !flow.empty()) return flow;
    if (record.outcome == core::Outcome::not_precise) return what_it_would_take(record);
    if (record.outcome == core::Outcome::bistable_or_slow) {
        return fmt::format("velocity efficiency {} when it starts below, {} when it starts above",
                           in_words(record.estimate.below), in_words(record.estimate.above));
    }
    return {};
}

store::CaseRecord evaluate_case(prepare::PreparedCase const& prepared, std::string const& id,
                                std::string const& engine_version, EvaluatedPackings packings) {
    store::CaseRecord record{};
    record.id = id;
    record.scenario = prepared.scenario;
    record.scenario_toml = to_toml(prepared.scenario);
    record.provenance = provenance_of(packings, engine_version);
    for (auto& [number, packing] : packings) record.packings.push_back(std::move(packing.record));
    add_estimate(record);
    record.layer_mode = common_mode(record.packings);
    return record;
}

}  // namespace vibrotrough::evaluate
