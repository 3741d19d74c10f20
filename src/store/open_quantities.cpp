#include "store/open_quantities.hpp"

#include "measure/mass_flow.hpp"
#include "store/measured_quantity.hpp"

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;
using Flow = measure::OpenFlow;

/// A member of a packing's OpenFlow.
template <auto member>
MeasuredNumber flow() {
    return packing_field([](auto& packing) -> auto& { return packing.open.*member; });
}

/// A column of the table `flow`, one value for the end of each cycle.
template <auto member>
PackingTable flow_column(std::string_view name, std::string_view units, std::string_view meaning) {
    return {"flow", {name, units, meaning}, packing_field([](auto& p) -> auto& {
                return p.series.open.*member;
            })};
}

}  // namespace

std::vector<PackingTable> const& open_tables() {
    using Series = measure::OpenSeries;
    static std::vector<PackingTable> const tables{
        flow_column<&Series::fed>(
            "fed", "1", "Grains that were fed until the end of cycle 0 ... n; only of open troughs"),
        flow_column<&Series::fed_mass>("fed_mass", "kg", "Their mass"),
        flow_column<&Series::left>("left", "1", "Grains that left the trough in the cycle"),
        flow_column<&Series::left_mass>("left_mass", "kg", "Their mass"),
        flow_column<&Series::held>("held", "1", "Grains in the trough at the end of the cycle"),
        flow_column<&Series::held_mass>("held_mass", "kg", "Their mass"),
        flow_column<&Series::window_mass>(
            "window_mass", "kg", "Mass in the window in which the speed is measured, mean over the cycle"),
        {"along",
         {"x", "m", "Middle of a bin along the trough, from the back wall; only of open troughs"},
         packing_field([](auto& p) -> auto& { return p.open.along.x; })},
        {"along",
         {"depth", "m", "Height of the layer in the bin if it had settled, mean over the cycles that count"},
         packing_field([](auto& p) -> auto& { return p.open.along.depth; })},
        {"along",
         {"velocity", "m/s", "Mean velocity of its grains along the trough; NaN where there were none"},
         packing_field([](auto& p) -> auto& { return p.open.along.speed; })},
        {"residence",
         {"time", "s",
          "0, 1 ... 100 % of the grains that left the trough had been in it no longer; none when fewer than "
          "20 "
          "left; only of open troughs"},
         packing_field([](auto& p) -> auto& { return p.open.residence; })},
    };
    return tables;
}

std::optional<double> measured_mass_per_area(Case record) {
    bool const is_batch = is_screen(record.scenario) && !is_open(record.scenario);
    if (is_batch) return {};  // it becomes less
    if (!is_open(record.scenario)) return mass_per_area(record.scenario);
    auto const depth = mean_over_packings(record, flow<&Flow::window_depth>());
    if (!depth) return {};
    return *depth * scenario::settled_solid_fraction * mean_density(record.scenario);
}

std::vector<Quantity> open_quantities() {
    std::vector<Quantity> rows;
    add_measured<&flow<&Flow::inflow>>(
        rows, "inflow", "inflow_half_width", "kg/s", "Mass flow into an open trough; NaN of other layers",
        {.place = 940, .unit = "t/h", .factor = tonnes_per_hour, .format = "{:.4g}", .position = 270});
    add_measured<&flow<&Flow::outflow>>(rows, "outflow", "outflow_half_width", "kg/s",
                                        "Mass flow over its edge",
                                        {.place = 944,
                                         .unit = "t/h",
                                         .factor = tonnes_per_hour,
                                         .format = "{:.4g}",
                                         .position = 272,
                                         .terminal = terminal_when_known("out", "t/h"),
                                         .report = ReportView{"outflow"}});
    add_measured<&flow<&Flow::hold_up>>(
        rows, "hold_up", "hold_up_half_width", "kg",
        "Mass in the trough, with grains that have passed the edge and are less than a diameter away from it",
        {.place = 948, .format = "{:.3g}", .position = 274, .report = ReportView{"hold-up"}});
    add_measured<&flow<&Flow::window_depth>>(rows, "window_depth", "window_depth_half_width", "m",
                                             "Height of the layer in the window, if it had settled",
                                             {.place = 952,
                                              .unit = "mm",
                                              .factor = 1000,
                                              .format = "{:.2f}",
                                              .position = 276,
                                              .terminal = terminal_when_known("depth", "mm"),
                                              .report = ReportView{"depth"}});
    add_measured<&flow<&Flow::residence_time>>(
        rows, "residence_time", "residence_time_half_width", "s",
        "Time from the feed to the edge, mean over the grains that left",
        {.place = 956,
         .format = "{:.3f}",
         .position = 278,
         .terminal = terminal_when_known("residence", "s"),
         .report = ReportView{"residence"}});
    add_measured<&flow<&Flow::residence_spread>>(
        rows, "residence_spread", "residence_spread_half_width", "s",
        "Standard deviation of this time over the grains",
        {.place = 960, .format = "{:.3f}", .position = 280, .report = ReportView{"spread"}});
    add_measured<&flow<&Flow::peclet>>(
        rows, "peclet", "peclet_half_width", "1",
        "Peclet number of the residence times (closed ends): large for plug flow",
        {.place = 964, .format = "{:.3g}", .position = 282, .report = ReportView{"Peclet"}});
    add_measured<&flow<&Flow::fill_time>>(
        rows, "fill_time", "fill_time_half_width", "s",
        "Time in which the empty trough filled to 95 % of its hold-up",
        {.place = 968, .format = "{:.3g}", .position = 284, .report = ReportView{"time to fill"}});
    for (Quantity& row : rows) row.may_be_missing = row.known_without_mean = true;
    return rows;
}

}  // namespace vibrotrough::store
