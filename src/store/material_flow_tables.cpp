#include "store/material_flow_tables.hpp"

#include "store/measured_quantity.hpp"

namespace vibrotrough::store {
namespace {

std::vector<double> const& share_of(PackingRecord const& packing) {
    return packing.open.materials_along.share;
}

std::vector<double> const& speed_of_material(PackingRecord const& packing) {
    return packing.open.materials_along.speed;
}

std::vector<double> const& index_along(PackingRecord const& packing) {
    return packing.open.materials_along.segregation;
}

template <auto member>
PackingTable column_of_flows(std::string_view name, std::string_view units, std::string_view meaning) {
    return {"material_flow", {name, units, meaning}, packing_field([](auto& p) -> auto& {
                return p.open.materials.*member;
            })};
}

template <auto member>
PackingTable column_along(std::string_view name, std::string_view units, std::string_view meaning) {
    return {"material_along", {name, units, meaning}, packing_field([](auto& p) -> auto& {
                return p.open.materials_along.*member;
            })};
}

std::vector<PackingTable> make_flow_tables() {
    using Flows = measure::MaterialFlows;
    using Along = measure::MaterialsAlong;
    return {
        column_of_flows<&Flows::speed>(
            "velocity", "m/s",
            "Velocity of material 0 ([grains]), 1 (the first of [[materials]]) and so "
            "on in the window; only of mixtures in open troughs"),
        column_of_flows<&Flows::segregation>("segregation", "1",
                                             "Its segregation index in the window, mean of the bins"),
        column_of_flows<&Flows::outflow>("outflow", "kg/s", "Its mass flow over the edge"),
        column_of_flows<&Flows::residence_time>(
            "residence_time", "s",
            "Its time from the feed to the edge; NaN when fewer than 20 of its grains left"),
        column_along<&Along::x>("x", "m",
                                "Middle of a bin along the trough, from the back wall: all bins for material "
                                "0, then for 1 and so on; only of mixtures in open troughs"),
        column_along<&Along::share>("share", "1", "Share of the material in the mass of the bin"),
        column_along<&Along::speed>("velocity", "m/s", "Its velocity; NaN where there was none"),
        column_along<&Along::segregation>("segregation", "1",
                                          "Its segregation index; NaN where it was alone or missing"),
    };
}

}  // namespace

std::span<PackingTable const> material_flow_tables() {
    static std::vector<PackingTable> const tables = make_flow_tables();
    return tables;
}

std::vector<Entry> const& materials_along_entries() {
    constexpr auto half_width =
        "Half-width of its interval at measure.confidence, Student's t over the packings; NaN with one "
        "packing";
    static std::vector<Entry> const entries{
        {"material", "1", "Name of the material; only of mixtures in open troughs"},
        {"x", "m", "Middle of a bin along the trough, from the back wall"},
        {"share", "1", "Share of the material in the mass of the bin, mean over the packings"},
        {"share_half_width", "1", half_width},
        {"velocity", "m/s", "Its velocity along the trough, mean over the packings; NaN where none has it"},
        {"velocity_half_width", "m/s", half_width},
        {"segregation", "1",
         "Segregation index: height of its centre of mass above that of the other materials over half the "
         "settled depth in the bin; NaN where it was alone or missing"},
        {"segregation_half_width", "1", half_width},
    };
    return entries;
}

std::vector<CaseValues> materials_along_table(CaseRecord const& record) {
    if (record.scenario.materials.empty() || !is_open(record.scenario) || record.packings.empty()) return {};
    std::vector<double> const& x = record.packings.front().open.materials_along.x;
    if (x.empty()) return {};
    auto const all = materials(record.scenario);
    std::vector<std::string> names;
    for (scenario::Material const& material : all)
        names.insert(names.end(), x.size() / all.size(), material.name);
    std::vector<CaseValues> columns{names, x};
    for (PackingColumn const column : {share_of, speed_of_material, index_along})
        over_packings(record, column, x.size()).put_into(columns);
    return columns;
}

}  // namespace vibrotrough::store
