#include "evaluate/rolling.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

namespace vibrotrough::evaluate {
namespace {

void refuse(store::PackingRecord& record, std::string const& reason) {
    record.rolling = {};
    record.rolling_problem = fmt::format(
        "the contacts at the floor are unknown ({}); to measure them, delete the case's folder and run again",
        reason);
}

measure::RollingFacts facts_of(store::PackingRecord const& record, scenario::Scenario const& s) {
    auto const& velocity = record.motion.curves.trough_velocity_x;  // the first cycle of the layer's period
    return {static_cast<double>(s.layer.grains),
            s.layer.length * s.layer.width * mean_diameter(s),
            record.estimate.discarded,
            record.estimate.discarded + record.estimate.measured,
            {velocity.begin(), velocity.begin() + measure::PhaseSeries::per_cycle}};
}

}  // namespace

void measure_rolling(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                     PackingFiles const& files, measure::PhaseSeries const& phases) {
    if (!prepared.scenario.measure.rolling || record.motion.curves.phase.empty()) return;
    if (files.rolling.content.empty()) {
        refuse(record, "rolling.csv is missing");
        return;
    }
    try {
        // Named without its folder, which may be another one when the result is read.
        core::TextFile const file{"rolling.csv", files.rolling.content};
        auto const series = measure::parse_rolling(file, prepared.time.steps_per_cycle);
        record.rolling = measure::rolling_curves(series, phases, facts_of(record, prepared.scenario));
    } catch (core::InputError const& error) {
        refuse(record, error.what());
    }
}

void hold_to_marker(store::PackingRecord& record, PackingFiles const& files, PackingMarker const& marker) {
    if (record.rolling.phase.empty() || marker.rolling_sha256 == files.rolling_sha256) return;
    refuse(record, "rolling.csv was changed after the run");
}

}  // namespace vibrotrough::evaluate
