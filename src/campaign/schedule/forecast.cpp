#include "campaign/schedule/forecast.hpp"

#include <algorithm>

namespace vibrotrough::campaign {
namespace {

/// Speed and cycles from the results that are there.
void measure_speed(std::vector<CaseOverview> const& cases, Forecast& forecast) {
    double work = 0, time = 0, cycles = 0, packings = 0;
    for (CaseOverview const& one : cases) {
        if (!one.record) continue;
        for (store::PackingRecord const& packing : one.record->packings) {
            double const done = packing.estimate.discarded + packing.estimate.measured;
            work += one.planned->prepared->grain_steps(done);
            time += packing.wall_time;
            cycles += done;
            ++packings;
        }
    }
    if (packings == 0 || time <= 0 || work <= 0) return;
    forecast = {work / time, true, cycles / packings, 0, {}};
}

}  // namespace

Forecast forecast(std::vector<CaseOverview> const& cases) {
    Forecast result{5e6, false, 40, 0, {}};
    measure_speed(cases, result);
    for (CaseOverview const& one : cases) {
        scenario::Scenario const& scenario = one.planned->scenario();
        int const missing = one.record ? 0 : scenario.measure.packings - one.packings_done;
        double const cycles = std::min<double>(result.cycles, scenario.measure.max_cycles + 10);
        result.cases.push_back(missing * one.planned->prepared->grain_steps(cycles) / result.speed);
        result.core_time += result.cases.back();
    }
    return result;
}

}  // namespace vibrotrough::campaign
