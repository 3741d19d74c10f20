#include "evaluate/screen.hpp"

#include "measure/screening.hpp"

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

}  // namespace

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
    return measure::size_imbalance(
        series, measure::parse_passed(files.snapshots, prepared.time.steps_per_cycle), sizes_of(prepared));
}

}  // namespace vibrotrough::evaluate
