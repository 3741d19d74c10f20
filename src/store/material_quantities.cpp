#include "store/material_quantities.hpp"

#include "measure/mass_flow.hpp"
#include "measure/segregation.hpp"
#include "scenario/reader/keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

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
                                        length_scale(trough));
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

/// A column with one number for each material.
std::vector<double> numbers(std::vector<scenario::Material> const& all,
                            double (*of)(scenario::Material const&)) {
    std::vector<double> values;
    for (scenario::Material const& material : all) values.push_back(of(material));
    return values;
}

/// Mean and half-width over the packings of a number for each material.
void add_values(std::vector<CaseValues>& columns, Case record, std::size_t materials, OfPacking of) {
    std::vector<double> means, widths;
    for (std::size_t material = 0; material < materials; ++material) {
        std::vector<double> const values = in_packings(record, of, material);
        means.push_back(mean_of(values));
        widths.push_back(half_width_of(record, values));
    }
    columns.emplace_back(std::move(means));
    columns.emplace_back(std::move(widths));
}

std::vector<CaseValues> materials_values(Case record) {
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
    add_values(columns, record, all.size(), efficiency_of);
    add_values(columns, record, all.size(), last_index);
    if (!is_open(record.scenario)) return columns;
    add_values(columns, record, all.size(), material_outflow);
    add_values(columns, record, all.size(), material_residence);
    return columns;
}

std::vector<CaseValues> segregation_values(Case record) {
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

bool has_materials(scenario::Scenario const& s) {
    return !s.materials.empty();
}

bool is_kept_mixture(scenario::Scenario const& s) {
    return has_materials(s) && !is_open(s);
}

bool is_fed_mixture(scenario::Scenario const& s) {
    return has_materials(s) && is_open(s);
}

auto flow_of(std::vector<double> measure::MaterialFlows::*member) {
    return field(&PackingRecord::open, &measure::OpenFlow::materials, member);
}

auto along(std::vector<double> measure::MaterialsAlong::*member) {
    return field(&PackingRecord::open, &measure::OpenFlow::materials_along, member);
}

std::vector<CaseValues> materials_along_values(Case record) {
    using Along = measure::MaterialsAlong;
    if (!is_fed_mixture(record.scenario) || record.packings.empty()) return {};
    std::vector<double> const& x = record.packings.front().open.materials_along.x;
    if (x.empty()) return {};
    auto const all = materials(record.scenario);
    std::vector<std::string> names;
    for (scenario::Material const& material : all)
        names.insert(names.end(), x.size() / all.size(), material.name);
    std::vector<CaseValues> columns{names, x};
    for (auto const member : {&Along::share, &Along::speed, &Along::segregation})
        over_packings(record, along(member), x.size()).put_into(columns);
    return columns;
}

PackingTable ends_table() {
    PackingTable table{"material_ends", "cycles + 1", is_kept_mixture, {}};
    for (std::size_t i = 0; i < measure::most_materials; ++i) {
        std::string const number = std::to_string(i);
        using Column = Field<PackingRecord, std::vector<double>>;
        Column const x([i](auto& p) -> auto& { return p.series.materials[i].x; });
        Column const z([i](auto& p) -> auto& { return p.series.materials[i].z; });
        table.columns.push_back({{"x_" + number, "m",
                                  "Centre of mass along the trough of material 0 ([grains]), 1 (the first of "
                                  "[[materials]]) and so "
                                  "on, at the end of cycle 0 ... n, unwrapped; only of mixtures"},
                                 x});
        table.columns.push_back({{"z_" + number, "m", "The same above the resting trough"}, z});
    }
    return table;
}

PackingTable flows_table() {
    using Flows = measure::MaterialFlows;
    return {"material_flow",
            "materials",
            is_fed_mixture,
            {{{"velocity", "m/s",
               "Velocity of material 0 ([grains]), 1 (the first of [[materials]]) and so on in the window; "
               "only of mixtures in open troughs"},
              flow_of(&Flows::speed)},
             {{"segregation", "1", "Its segregation index in the window, mean of the bins"},
              flow_of(&Flows::segregation)},
             {{"outflow", "kg/s", "Its mass flow over the edge"}, flow_of(&Flows::outflow)},
             {{"residence_time", "s",
               "Its time from the feed to the edge; NaN when fewer than 20 of its grains left"},
              flow_of(&Flows::residence_time)}}};
}

PackingTable along_table() {
    using Along = measure::MaterialsAlong;
    return {
        "material_along",
        "materials * bins",
        is_fed_mixture,
        {{{"x", "m",
           "Middle of a bin along the trough, from the back wall: all bins for material 0, then for 1 and "
           "so on; only of mixtures in open troughs"},
          along(&Along::x)},
         {{"share", "1", "Share of the material in the mass of the bin"}, along(&Along::share)},
         {{"velocity", "m/s", "Its velocity; NaN where there was none"}, along(&Along::speed)},
         {{"segregation", "1", "Its segregation index; NaN where it was alone or missing"},
          along(&Along::segregation)}}};
}

CaseTable materials_table() {
    std::vector<Entry> entries{
        {"name", "1", "Name of the material, that of [grains] first; only of mixtures"},
        {"number_fraction", "1", "Its share of the grains"},
        {"diameter", "m", "Mean diameter d of its grains"},
        {"density", "kg/m3", "Density of its grains"},
        {"friction", "1", "Friction coefficient of the material on itself"},
        {"trough_friction", "1", "Friction coefficient mu on the trough"},
    };
    add_measured(entries, {"efficiency", "1",
                           "Velocity efficiency of the material's centre of mass, over the cycles kept; "
                           "in an open trough of its grains in the window, over the cycles with which "
                           "flows are measured"});
    add_measured(
        entries,
        {"segregation", "1",
         "Segregation index S: height of its centre of mass above that of the other materials over "
         "half the height of the layer, over the last tenth of the cycles, or in the window of an open "
         "trough; 1 on top, -1 at the floor, 0 mixed"});
    add_measured(entries, {"outflow", "kg/s", "Its mass flow over the edge; only of open troughs"});
    add_measured(entries,
                 {"residence_time", "s", "Its time from the feed to the edge; only of open troughs"});
    return {"materials", "materials", entries, materials_values, "name"};
}

CaseTable materials_along_table() {
    std::vector<Entry> entries{{"material", "1", "Name of the material; only of mixtures in open troughs"},
                               {"x", "m", "Middle of a bin along the trough, from the back wall"}};
    add_measured(entries,
                 {"share", "1", "Share of the material in the mass of the bin, mean over the packings"});
    add_measured(entries, {"velocity", "m/s",
                           "Its velocity along the trough, mean over the packings; NaN where none has "
                           "it"});
    add_measured(entries, {"segregation", "1",
                           "Segregation index: height of its centre of mass above that of the other "
                           "materials over half the settled depth in the bin; NaN where it was alone or "
                           "missing"});
    return {"materials_along", "materials * bins", entries, materials_along_values, "material"};
}

CaseTable segregation_table() {
    std::vector<Entry> entries{{"cycle", "1", "Number of cycles since the start; only of mixtures"}};
    for (int i = 0; i < measure::most_materials; ++i) {
        add_measured(entries,
                     {fmt::format("index_{}", i), "1",
                      "Segregation index of material 0 ([grains]), 1 (the first of [[materials]]) and "
                      "so on at the end of the cycle, mean over the packings"});
        entries.back().name = fmt::format("half_width_{}", i);
    }
    return {"segregation", "cycles + 1", entries, segregation_values};
}

}  // namespace

std::vector<PackingTable> material_tables() {
    return {ends_table(), flows_table(), along_table()};
}

std::vector<CaseTable> materials_case_tables() {
    return {materials_table(), materials_along_table(), segregation_table()};
}

void add_materials(CaseRecord& record) {
    if (!is_mixture(record)) return;
    for (PackingRecord& packing : record.packings) {
        packing.segregation = last_index(record, packing, 1);
        packing.material_lead = lead_of(record, packing, 1);
    }
}

std::vector<Quantity> material_quantities() {
    std::vector<Quantity> rows;
    add_measured(
        rows, field(&PackingRecord::segregation), {"segregation", "segregation_half_width"}, "1",
        "Segregation index of the first of [[materials]], over the last tenth of the cycles, or in the "
        "window of an open trough: 1 when it lies on top of the others, -1 at the floor, 0 when the "
        "layer is mixed; NaN without materials",
        {.format = "{:.3f}",
         .terminal = terminal_when_known("segregation"),
         .report = ReportView{"segregation"}});
    add_measured(
        rows, field(&PackingRecord::material_lead), {"material_lead", "material_lead_half_width"}, "1",
        "Velocity efficiency of the first of [[materials]] less that of the grains: how much faster it "
        "is conveyed; NaN without materials",
        {.format = "{:.3f}", .report = ReportView{"lead of the material"}});
    return rows;
}

}  // namespace vibrotrough::store
