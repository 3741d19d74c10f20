#include "evaluate/screen.hpp"

#include "measure/open_flow.hpp"
#include "measure/screening.hpp"
#include "measure/size_flows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vibrotrough::evaluate {
namespace {

std::vector<measure::ScreenedSize> sizes_of(prepare::PreparedCase const& prepared) {
    double const density = prepared.scenario.grains.density;
    std::vector<measure::ScreenedSize> sizes;
    for (prepare::ClassCount const& one : prepared.classes)
        sizes.push_back(
            {one.diameter, one.count, density * std::numbers::pi / 6 * std::pow(one.diameter, 3)});
    return sizes;
}

std::vector<measure::SizeFlow> flows_of(prepare::PreparedCase const& prepared, PackingFiles const& files,
                                        measure::CycleSeries const& series) {
    int const steps = prepared.time.steps_per_cycle;
    return measure::size_flows(series, measure::parse_left_sizes(files.snapshots, steps),
                               measure::parse_passed(files.snapshots, steps), sizes_of(prepared));
}

}  // namespace

void measure_fed_screen(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                        PackingFiles const& files) {
    scenario::Scenario const& s = prepared.scenario;
    int const from = std::max(record.estimate.discarded, measure::cycles_to_fill(record.series));
    record.screening =
        measure::screening_of_flows(flows_of(prepared, files, record.series), *s.screen.opening, from,
                                    record.series.cycles(), 1 / s.trough.frequency);
}

void measure_screen(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                    PackingFiles const& files) {
    scenario::Scenario const& s = prepared.scenario;
    record.screening =
        measure::screening(record.series, measure::parse_passed(files.snapshots, record.steps_per_cycle),
                           sizes_of(prepared), *s.screen.opening, 1 / s.trough.frequency);
}

std::optional<std::string> missing_on_screen(prepare::PreparedCase const& prepared, PackingFiles const& files,
                                             measure::CycleSeries const& series) {
    if (!prepared.domain.screen) return {};
    if (is_fed_screen(prepared.scenario))
        return measure::flow_imbalance(series, flows_of(prepared, files, series));
    return measure::size_imbalance(
        series, measure::parse_passed(files.snapshots, prepared.time.steps_per_cycle), sizes_of(prepared));
}

}  // namespace vibrotrough::evaluate
