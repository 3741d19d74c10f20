#include "store/open_quantities.hpp"

#include "measure/mass_flow.hpp"
#include "measure/open_flow.hpp"

#include <cmath>
#include <limits>

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;
using Flow = measure::OpenFlow;
using Along = measure::AlongTrough;
using Series = measure::OpenSeries;
using Column = Field<PackingRecord, std::vector<double>>;

MeasuredNumber flow(std::optional<double> Flow::*member) {
    return field(&PackingRecord::open, member);
}

Column along(std::vector<double> Along::*member) {
    return field(&PackingRecord::open, &Flow::along, member);
}

/// One value for the end of each cycle.
Column cycle(std::vector<double> Series::*member) {
    return field(&PackingRecord::series, &measure::CycleSeries::open, member);
}

Column residence() {
    return field(&PackingRecord::open, &Flow::residence);
}

/// The column of the first packing that has it, of an open trough. All packings have the same rows.
std::vector<double> first_of(Case record, Column const& column) {
    if (!is_open(record.scenario)) return {};
    for (PackingRecord const& packing : record.packings)
        if (!column(packing).empty()) return column(packing);
    return {};
}

std::vector<CaseValues> along_trough_values(Case record) {
    std::vector<double> const x = first_of(record, along(&Along::x));
    if (x.empty()) return {};
    std::vector<CaseValues> columns{x};
    over_packings(record, along(&Along::depth), x.size()).put_into(columns);
    over_packings(record, along(&Along::speed), x.size()).put_into(columns);
    return columns;
}

std::vector<CaseValues> residence_times_values(Case record) {
    std::size_t const rows = first_of(record, residence()).size();
    if (rows == 0) return {};
    std::vector<double> shares;
    for (std::size_t row = 0; row < rows; ++row)
        shares.push_back(static_cast<double>(row) / static_cast<double>(rows - 1));
    std::vector<CaseValues> columns{shares};
    over_packings(record, residence(), rows).put_into(columns);
    return columns;
}

/// kg/m^2, of a settled layer.
double mass_of_depth(Case record, double depth) {
    return depth * scenario::settled_solid_fraction * mean_density(record.scenario);
}

}  // namespace

std::vector<PackingTable> open_tables() {
    return {
        {"flow",
         "cycles + 1",
         scenario::is_open,
         {{{"fed", "1", "Grains that were fed until the end of cycle 0 ... n; only of open troughs"},
           cycle(&Series::fed)},
          {{"fed_mass", "kg", "Their mass"}, cycle(&Series::fed_mass)},
          {{"left", "1", "Grains that left the trough in the cycle"}, cycle(&Series::left)},
          {{"left_mass", "kg", "Their mass"}, cycle(&Series::left_mass)},
          {{"held", "1", "Grains in the trough at the end of the cycle"}, cycle(&Series::held)},
          {{"held_mass", "kg", "Their mass"}, cycle(&Series::held_mass)},
          {{"window_mass", "kg", "Mass in the window in which the speed is measured, mean over the cycle"},
           cycle(&Series::window_mass)}}},
        {"along",
         "bins",
         scenario::is_open,
         {{{"x", "m", "Middle of a bin along the trough, from the back wall; only of open troughs"},
           along(&Along::x)},
          {{"depth", "m",
            "Height of the layer in the bin if it had settled, mean over the width and over the cycles that "
            "count"},
           along(&Along::depth)},
          {{"level", "m",
            "Its surface above the lowest point of the trough if it had settled; only of a trough of your "
            "own"},
           along(&Along::level)},
          {{"velocity", "m/s", "Mean velocity of its grains along the trough; NaN where there were none"},
           along(&Along::speed)}}},
        {"residence",
         "101",
         scenario::is_open,
         {{{"time", "s",
            "0, 1 ... 100 % of the grains that left the trough had been in it no longer; none when fewer "
            "than 20 left; only of open troughs"},
           residence()}}},
    };
}

std::vector<CaseTable> open_case_tables() {
    std::vector<Entry> along_entries{
        {"x", "m", "Middle of a bin along the trough, from the back wall; only of open troughs"}};
    add_measured(along_entries,
                 {"depth", "m",
                  "Height of the layer in the bin if it had settled, mean over the cycles that "
                  "count and the packings"});
    add_measured(along_entries, {"velocity", "m/s",
                                 "Mean velocity of its grains along the trough, mean over the packings with "
                                 "grains there; NaN where none has"});
    std::vector<Entry> time_entries{{"share", "1", "0, 0.01 ... 1 of the grains that left an open trough"}};
    add_measured(time_entries,
                 {"time", "s",
                  "They had been in it no longer, mean over the packings in which at least 20 grains left"});
    return {{"along_trough", "bins", along_entries, along_trough_values},
            {"residence_times", "101", time_entries, residence_times_values}};
}

std::optional<double> measured_mass_per_area(Case record) {
    bool const is_batch = is_screen(record.scenario) && !is_open(record.scenario);
    if (is_batch) return {};  // it becomes less
    if (!is_open(record.scenario)) return mass_per_area(record.scenario);
    auto const depth = mean_over_packings(record, flow(&Flow::window_depth));
    if (!depth) return {};
    return mass_of_depth(record, *depth);
}

std::optional<double> open_flow_half_width(Case record) {
    auto const mass = measured_mass_per_area(record);
    if (!mass || !record.estimate.mean) return {};
    double const scale = velocity_scale(record.scenario.trough);
    std::vector<double> flows;
    for (PackingRecord const& packing : record.packings)
        if (auto const depth = packing.open.window_depth)
            flows.push_back(packing.estimate.mean * scale * mass_of_depth(record, *depth));
    double const scatter = measure::student_half_width(flows, record.scenario.measure.confidence)
                               .value_or(std::numeric_limits<double>::infinity());
    double const shared = std::hypot(record.estimate.drift, record.numerical_error().value_or(0));
    return std::hypot(scatter, shared * scale * *mass);
}

std::vector<Quantity> open_quantities() {
    std::vector<Quantity> rows;
    add_measured(rows, flow(&Flow::inflow), {"inflow", "inflow_half_width"}, "kg/s",
                 "Mass flow into an open trough; NaN of other layers",
                 {.unit = "t/h", .factor = tonnes_per_hour, .format = "{:.4g}"});
    add_measured(rows, flow(&Flow::outflow), {"outflow", "outflow_half_width"}, "kg/s",
                 "Mass flow over its edge",
                 {.unit = "t/h",
                  .factor = tonnes_per_hour,
                  .format = "{:.4g}",
                  .terminal = terminal_when_known("out", "t/h"),
                  .report = ReportView{"outflow"}});
    add_measured(
        rows, flow(&Flow::hold_up), {"hold_up", "hold_up_half_width"}, "kg",
        "Mass in the trough, with grains that have passed the edge and are less than a diameter away from it",
        {.format = "{:.3g}", .report = ReportView{"hold-up"}});
    add_measured(rows, flow(&Flow::window_depth), {"window_depth", "window_depth_half_width"}, "m",
                 "Height of the layer in the window, if it had settled, as a mean over the width",
                 {.unit = "mm",
                  .factor = 1000,
                  .format = "{:.2f}",
                  .terminal = terminal_when_known("depth", "mm"),
                  .report = ReportView{"depth"}});
    add_measured(rows, flow(&Flow::residence_time), {"residence_time", "residence_time_half_width"}, "s",
                 "Time from the feed to the edge, mean over the grains that left",
                 {.format = "{:.3f}",
                  .terminal = terminal_when_known("residence", "s"),
                  .report = ReportView{"residence"}});
    add_measured(rows, flow(&Flow::residence_spread), {"residence_spread", "residence_spread_half_width"},
                 "s", "Standard deviation of this time over the grains",
                 {.format = "{:.3f}", .report = ReportView{"spread"}});
    add_measured(rows, flow(&Flow::peclet), {"peclet", "peclet_half_width"}, "1",
                 "Peclet number of the residence times (closed ends): large for plug flow",
                 {.format = "{:.3g}", .report = ReportView{"Peclet"}});
    add_measured(rows, flow(&Flow::fill_time), {"fill_time", "fill_time_half_width"}, "s",
                 "Time in which the empty trough filled to 95 % of its hold-up",
                 {.format = "{:.3g}", .report = ReportView{"time to fill"}});
    return rows;
}

}  // namespace vibrotrough::store
