#include "evaluate/case.hpp"

#include "evaluate/layer.hpp"

#include <algorithm>
#include <vector>

namespace vibrotrough::evaluate {
namespace {

core::Outcome outcome_of(std::vector<measure::PackingEstimate> const& packings) {
    auto const any = [&](measure::Verdict verdict) {
        return std::ranges::any_of(packings, [&](auto const& packing) { return packing.verdict == verdict; });
    };
    if (any(measure::Verdict::not_steady)) return core::Outcome::not_steady;
    if (any(measure::Verdict::not_precise)) return core::Outcome::not_precise;
    return core::Outcome::finished;
}

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

}  // namespace

store::CaseRecord evaluate_case(prepare::PreparedCase const& prepared, std::string const& id,
                                std::string const& engine_version, EvaluatedPackings packings) {
    store::CaseRecord record{};
    record.id = id;
    record.scenario = prepared.scenario;
    record.scenario_toml = to_toml(prepared.scenario);
    record.provenance = provenance_of(packings, engine_version);
    std::vector<measure::PackingEstimate> estimates;
    for (auto& [number, packing] : packings) {
        estimates.push_back(packing.record.estimate);
        record.packings.push_back(std::move(packing.record));
    }
    record.estimate = measure::combine(estimates, prepared.scenario.measure.confidence);
    record.outcome = outcome_of(estimates);
    record.layer_mode = common_mode(record.packings);
    if (record.outcome == core::Outcome::not_steady) {
        // No mean is reported unless the case is steady; the cycles stay in the record.
        record.estimate.mean.reset();
        record.estimate.half_width.reset();
    }
    return record;
}

}  // namespace vibrotrough::evaluate
