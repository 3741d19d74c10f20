#include "store/material_quantities.hpp"

#include "measure/mass_flow.hpp"
#include "measure/segregation.hpp"
#include "scenario/reader/keys.hpp"
#include "store/material_flow_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;

// The campaign file allows as many materials as cycles.csv has columns for.
static_assert(scenario::most_added_materials + 1 == measure::most_materials);

bool is_mixture(Case record) {
    return !record.scenario.materials.empty() && !record.packings.empty();
}

/// One number for each packing.
using OfPacking = double (*)(Case, PackingRecord const&, std::size_t material);

double unknown() {
    return std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> index_of(Case record, PackingRecord const& packing, std::size_t material) {
    std::vector<double> masses;
    for (scenario::Material const& one : materials(record.scenario))
        masses.push_back(one.number_fraction * one.grains.density * mean_grain_volume(one.grains));
    std::span const all(packing.series.materials.data(), masses.size());
    return measure::segregation_index(all, masses, material, layer_height(record.scenario));
}

/// A number of the materials that was measured in an open trough.
double of_flow(std::vector<double> const& values, std::size_t material) {
    return material < values.size() ? values[material] : unknown();
}

/// The mean over the last cycles, or in the window of an open trough.
double last_index(Case record, PackingRecord const& packing, std::size_t material) {
    if (is_open(record.scenario)) return of_flow(packing.open.materials.segregation, material);
    std::vector<double> const index = index_of(record, packing, material);
    if (index.empty()) return unknown();
    int const count = measure::last_cycles(static_cast<int>(index.size()) - 1);
    return std::accumulate(index.end() - count, index.end(), 0.0) / count;
}

double material_outflow(Case, PackingRecord const& packing, std::size_t material) {
    return of_flow(packing.open.materials.outflow, material);
}

double material_residence(Case, PackingRecord const& packing, std::size_t material) {
    return of_flow(packing.open.materials.residence_time, material);
}

double efficiency_of(Case record, PackingRecord const& packing, std::size_t material) {
    scenario::Trough const& trough = record.scenario.trough;
    if (is_open(record.scenario))
        return of_flow(packing.open.materials.speed, material) / velocity_scale(trough);
    return measure::material_efficiency(packing.series.materials[material], packing.estimate.discarded,
                                        trough.amplitude * std::cos(trough.vibration_angle));
}

double lead_of(Case record, PackingRecord const& packing, std::size_t material) {
    return efficiency_of(record, packing, material) - efficiency_of(record, packing, 0);
}

std::vector<double> in_packings(Case record, OfPacking of, std::size_t material) {
    std::vector<double> values;
    for (PackingRecord const& packing : record.packings)
        if (double const one = of(record, packing, material); !std::isnan(one)) values.push_back(one);
    return values;
}

double mean_of(std::vector<double> const& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double half_width_of(Case record, std::vector<double> const& values) {
    return measure::student_half_width(values, record.scenario.measure.confidence).value_or(unknown());
}

/// The field of a packing as a quantity.
using OptionalNumber = Field<PackingRecord, std::optional<double>>;

OptionalNumber segregation() {
    return packing_field([](auto& packing) -> auto& { return packing.segregation; });
}

OptionalNumber lead() {
    return packing_field([](auto& packing) -> auto& { return packing.material_lead; });
}

/// A column with one number for each material.
std::vector<double> numbers(std::vector<scenario::Material> const& all,
                            double (*of)(scenario::Material const&)) {
    std::vector<double> values;
    for (scenario::Material const& material : all) values.push_back(of(material));
    return values;
}

/// Mean and half-width over the packings of a number for each material.
void add_measured(std::vector<CaseValues>& columns, Case record, std::size_t materials, OfPacking of) {
    std::vector<double> means, widths;
    for (std::size_t material = 0; material < materials; ++material) {
        std::vector<double> const values = in_packings(record, of, material);
        means.push_back(mean_of(values));
        widths.push_back(half_width_of(record, values));
    }
    columns.emplace_back(std::move(means));
    columns.emplace_back(std::move(widths));
}

template <std::size_t i>
void add_series(std::vector<PackingTable>& tables) {
    constexpr std::array x{"x_0", "x_1", "x_2", "x_3"}, z{"z_0", "z_1", "z_2", "z_3"};
    tables.push_back(
        {"material_ends",
         {x[i], "m",
          "Centre of mass along the trough of material 0 ([grains]), 1 (the first of [[materials]]) "
          "and so on, at the end of cycle 0 ... n, unwrapped; only of mixtures"},
         packing_field([](auto& p) -> auto& { return p.series.materials[i].x; })});
    tables.push_back({"material_ends", {z[i], "m", "The same above the resting trough"}, packing_field([
                      ](auto& p) -> auto& { return p.series.materials[i].z; })});
}

}  // namespace

std::span<PackingTable const> material_tables(std::size_t materials, bool open) {
    static std::vector<PackingTable> const tables = [] {
        std::vector<PackingTable> all;
        add_series<0>(all);
        add_series<1>(all);
        add_series<2>(all);
        add_series<3>(all);
        return all;
    }();
    if (materials < 2) return {};
    return open ? material_flow_tables() : std::span(tables).first(2 * materials);
}

std::vector<Entry> const& materials_entries() {
    static std::vector<Entry> const entries{
        {"name", "1", "Name of the material, that of [grains] first; only of mixtures"},
        {"number_fraction", "1", "Its share of the grains"},
        {"diameter", "m", "Mean diameter d of its grains"},
        {"density", "kg/m3", "Density of its grains"},
        {"friction", "1", "Friction coefficient of the material on itself"},
        {"trough_friction", "1", "Friction coefficient mu on the trough"},
        {"efficiency", "1",
         "Velocity efficiency of the material's centre of mass, over the cycles kept; in an open trough of "
         "its "
         "grains in the window, over the cycles with which flows are measured"},
        {"efficiency_half_width", "1",
         "Half-width of its interval at measure.confidence, Student's t over the packings; NaN with one "
         "packing"},
        {"segregation", "1",
         "Segregation index S: height of its centre of mass above that of the other materials over half the "
         "height of the layer, over the last tenth of the cycles, or in the window of an open trough; 1 on "
         "top, -1 at the floor, 0 mixed"},
        {"segregation_half_width", "1", "Half-width of its interval, as for efficiency"},
        {"outflow", "kg/s", "Its mass flow over the edge; only of open troughs"},
        {"outflow_half_width", "kg/s", "Half-width of its interval, as for efficiency"},
        {"residence_time", "s", "Its time from the feed to the edge; only of open troughs"},
        {"residence_time_half_width", "s", "Half-width of its interval, as for efficiency"},
    };
    return entries;
}

std::vector<CaseValues> materials_table(Case record) {
    if (!is_mixture(record)) return {};
    using Material = scenario::Material;
    auto const all = materials(record.scenario);
    std::vector<std::string> names;
    for (Material const& material : all) names.push_back(material.name);
    std::vector<CaseValues> columns{
        names,
        numbers(all, [](Material const& m) { return m.number_fraction; }),
        numbers(all, [](Material const& m) { return m.grains.diameter; }),
        numbers(all, [](Material const& m) { return m.grains.density; }),
        numbers(all, [](Material const& m) { return m.grains.friction; }),
        numbers(all, [](Material const& m) { return m.trough_friction; }),
    };
    add_measured(columns, record, all.size(), efficiency_of);
    add_measured(columns, record, all.size(), last_index);
    if (!is_open(record.scenario)) return columns;
    add_measured(columns, record, all.size(), material_outflow);
    add_measured(columns, record, all.size(), material_residence);
    return columns;
}

std::vector<Entry> const& segregation_entries() {
    constexpr auto mean =
        "Segregation index of material 0 ([grains]), 1 (the first of [[materials]]) and so on at the end of "
        "the "
        "cycle, mean over the packings";
    constexpr auto half_width =
        "Half-width of its interval at measure.confidence, Student's t over the packings; NaN with one "
        "packing";
    static std::vector<Entry> const entries{
        {"cycle", "1", "Number of cycles since the start; only of mixtures"},
        {"index_0", "1", mean},
        {"half_width_0", "1", half_width},
        {"index_1", "1", mean},
        {"half_width_1", "1", half_width},
        {"index_2", "1", mean},
        {"half_width_2", "1", half_width},
        {"index_3", "1", mean},
        {"half_width_3", "1", half_width},
    };
    return entries;
}

std::vector<CaseValues> segregation_table(Case record) {
    if (!is_mixture(record) || is_open(record.scenario)) return {};
    std::size_t cycle_ends = record.packings.front().series.x.size();
    for (PackingRecord const& packing : record.packings)
        cycle_ends = std::min(cycle_ends, packing.series.materials[0].z.size());
    std::vector<double> cycles(cycle_ends);
    std::iota(cycles.begin(), cycles.end(), 0.0);
    std::vector<CaseValues> columns{cycles};
    for (std::size_t material = 0; material <= record.scenario.materials.size(); ++material) {
        std::vector<std::vector<double>> indices;
        for (PackingRecord const& packing : record.packings)
            indices.push_back(index_of(record, packing, material));
        std::vector<double> means, widths;
        for (std::size_t k = 0; k < cycle_ends; ++k) {
            std::vector<double> values;
            for (auto const& index : indices) values.push_back(index[k]);
            means.push_back(mean_of(values));
            widths.push_back(half_width_of(record, values));
        }
        columns.emplace_back(std::move(means));
        columns.emplace_back(std::move(widths));
    }
    return columns;
}

void add_materials(CaseRecord& record) {
    if (!is_mixture(record)) return;
    for (PackingRecord& packing : record.packings) {
        packing.segregation = last_index(record, packing, 1);
        packing.material_lead = lead_of(record, packing, 1);
    }
}

std::vector<Quantity> material_quantities() {
    std::vector<Quantity> rows{
        {"segregation",
         "1",
         "Segregation index of the first of [[materials]], over the last tenth of the cycles, or in the "
         "window of an open trough: 1 when it lies on top of the others, -1 at the floor, 0 when the layer "
         "is "
         "mixed; NaN without materials",
         segregation(),
         OverPackings::mean,
         {{.place = 900,
           .format = "{:.3f}",
           .position = 262,
           .terminal = TerminalView{.heading = "segregation", .priority = 4, .only_when_known = true},
           .report = ReportView{"segregation"}}}},
        {"segregation_half_width",
         "1",
         "Half-width of the interval of segregation, Student's t over the packings",
         +[](Case c) { return half_width_over_packings(c, segregation()); },
         OverPackings::nothing,
         {{.place = 910,
           .format = "{:.3f}",
           .position = 264,
           .terminal = TerminalView{.heading = "+-", .priority = 4, .only_when_known = true},
           .report = ReportView{"\u00b1"}}}},
        {"material_lead",
         "1",
         "Velocity efficiency of the first of [[materials]] less that of the grains: how much faster it is "
         "conveyed; NaN without materials",
         lead(),
         OverPackings::mean,
         {{.place = 920, .format = "{:.3f}", .position = 266, .report = ReportView{"lead of the material"}}}},
        {"material_lead_half_width",
         "1",
         "Half-width of the interval of material_lead, Student's t over the packings",
         +[](Case c) { return half_width_over_packings(c, lead()); },
         OverPackings::nothing,
         {{.place = 930, .format = "{:.3f}", .position = 268, .report = ReportView{"\u00b1 lead"}}}},
    };
    for (Quantity& row : rows) row.may_be_missing = row.known_without_mean = true;
    return rows;
}

}  // namespace vibrotrough::store
