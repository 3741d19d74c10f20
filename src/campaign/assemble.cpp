#include "campaign/assemble.hpp"

#include "campaign/layer.hpp"
#include "core/error.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

std::string outcome_of(std::vector<measure::PackingEstimate> const& packings) {
    auto const any = [&](measure::Verdict verdict) {
        return std::ranges::any_of(packings, [&](auto const& packing) { return packing.verdict == verdict; });
    };
    if (any(measure::Verdict::not_steady)) return "not-steady";
    if (any(measure::Verdict::not_precise)) return "not-precise";
    return "finished";
}

MeasuredPacking obtain(PlannedCase const& planned, int packing, MeasuredPackings& known) {
    if (auto const found = known.find(packing); found != known.end()) return std::move(found->second);
    auto read = read_measured_packing(planned, packing);
    if (!read)
        throw core::InputError(fmt::format("packing {} of case {} is not finished", packing, planned.id));
    return std::move(*read);
}

}  // namespace

store::CaseRecord assemble(PlannedCase const& planned, std::string const& engine_version,
                           MeasuredPackings known) {
    store::CaseRecord record{};
    record.id = planned.id;
    record.scenario = planned.scenario;
    record.scenario_toml = to_toml(planned.scenario);
    std::vector<measure::PackingEstimate> estimates;
    for (int packing = 1; packing <= planned.scenario.measure.packings; ++packing) {
        MeasuredPacking measured = obtain(planned, packing, known);
        FinishedPacking const& marker = measured.run;
        record.packings.push_back(std::move(measured.record));
        estimates.push_back(record.packings.back().estimate);
        auto& [version, commit, engine, certificate, host, started, finished] = record.provenance;
        if (packing == 1) {
            record.provenance = {marker.program_version,
                                 marker.git_commit,
                                 engine_version,
                                 marker.engine_certificate,
                                 marker.host,
                                 marker.started,
                                 marker.finished};
        }
        started = std::min(started, marker.started);  // ISO 8601 sorts as text
        finished = std::max(finished, marker.finished);
    }
    record.estimate = measure::combine(estimates, planned.scenario.measure.confidence);
    record.outcome = outcome_of(estimates);
    record.layer_mode = common_mode(record.packings);
    if (record.outcome == "not-steady") {
        // No mean is reported unless the case is steady; the cycles stay in the record.
        record.estimate.mean.reset();
        record.estimate.half_width.reset();
    }
    return record;
}

}  // namespace vibrotrough::campaign
