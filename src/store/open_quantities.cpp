#include "store/open_quantities.hpp"

#include "measure/mass_flow.hpp"
#include "store/measured_quantity.hpp"

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;
using Flow = measure::OpenFlow;

constexpr std::string_view level_column = "level";

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

std::vector<double> const& place_of(PackingRecord const& packing) {
    return packing.open.along.x;
}

std::vector<double> const& depth_of(PackingRecord const& packing) {
    return packing.open.along.depth;
}

std::vector<double> const& speed_of(PackingRecord const& packing) {
    return packing.open.along.speed;
}

std::vector<double> const& residence_of(PackingRecord const& packing) {
    return packing.open.residence;
}

/// The column of the first packing that has it, of an open trough. All packings have the same rows.
std::vector<double> first_of(Case record, PackingColumn column) {
    if (!is_open(record.scenario)) return {};
    for (PackingRecord const& packing : record.packings)
        if (!column(packing).empty()) return column(packing);
    return {};
}

constexpr auto half_width_meaning =
    "Half-width of its interval at measure.confidence, Student's t over the packings; NaN with one packing";

std::vector<PackingTable> make_open_tables(bool mesh) {
    using Series = measure::OpenSeries;
    std::vector<PackingTable> tables{
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
         {"depth", "m",
          "Height of the layer in the bin if it had settled, mean over the width and over the cycles that "
          "count"},
         packing_field([](auto& p) -> auto& { return p.open.along.depth; })},
        {"along",
         {level_column, "m",
          "Its surface above the lowest point of the trough if it had settled; only of a trough of your own"},
         packing_field([](auto& p) -> auto& { return p.open.along.level; })},
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
    if (!mesh) std::erase_if(tables, [](PackingTable const& one) { return one.entry.name == level_column; });
    return tables;
}

}  // namespace

std::vector<PackingTable> const& open_tables(bool mesh) {
    static std::vector<PackingTable> const on_flat_floors = make_open_tables(false),
                                           on_meshes = make_open_tables(true);
    return mesh ? on_meshes : on_flat_floors;
}

std::vector<Entry> const& along_trough_entries() {
    static std::vector<Entry> const entries{
        {"x", "m", "Middle of a bin along the trough, from the back wall; only of open troughs"},
        {"depth", "m",
         "Height of the layer in the bin if it had settled, mean over the cycles that count and the "
         "packings"},
        {"depth_half_width", "m", half_width_meaning},
        {"velocity", "m/s",
         "Mean velocity of its grains along the trough, mean over the packings with grains there; NaN where "
         "none has"},
        {"velocity_half_width", "m/s", half_width_meaning},
    };
    return entries;
}

std::vector<CaseValues> along_trough_table(Case record) {
    std::vector<double> const x = first_of(record, place_of);
    if (x.empty()) return {};
    std::vector<CaseValues> columns{x};
    over_packings(record, depth_of, x.size()).put_into(columns);
    over_packings(record, speed_of, x.size()).put_into(columns);
    return columns;
}

std::vector<Entry> const& residence_times_entries() {
    static std::vector<Entry> const entries{
        {"share", "1", "0, 0.01 ... 1 of the grains that left an open trough"},
        {"time", "s",
         "They had been in it no longer, mean over the packings in which at least 20 grains left"},
        {"time_half_width", "s", half_width_meaning},
    };
    return entries;
}

std::vector<CaseValues> residence_times_table(Case record) {
    std::size_t const rows = first_of(record, residence_of).size();
    if (rows == 0) return {};
    std::vector<double> shares;
    for (std::size_t row = 0; row < rows; ++row)
        shares.push_back(static_cast<double>(row) / static_cast<double>(rows - 1));
    std::vector<CaseValues> columns{shares};
    over_packings(record, residence_of, rows).put_into(columns);
    return columns;
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
    add_measured<&flow<&Flow::window_depth>>(
        rows, "window_depth", "window_depth_half_width", "m",
        "Height of the layer in the window, if it had settled, as a mean over the width",
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
