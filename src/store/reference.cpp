#include "store/reference.hpp"

#include "store/material_flow_tables.hpp"
#include "store/observable.hpp"
#include "store/open_quantities.hpp"
#include "store/schema.hpp"
#include "store/screen_quantities.hpp"
#include "store/stage_quantities.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace vibrotrough::store {
namespace {

constexpr std::string_view real_type = "float64", whole_type = "int32", word_type = "text", scalar = "scalar";

/// What there is one value of in a table of a packing.
std::string_view shape_of(std::string_view group) {
    if (group == "profiles") return "bins";
    return group == "surface" ? "columns" : "samples";
}

std::string_view type_of(CaseNumber const& value) {
    return std::array{whole_type, real_type, word_type}.at(value.index());
}

/// The type of a field of packings in the files.
template <typename Value>
std::string_view type_of(Field<PackingRecord, Value> const& /*field*/) {
    if constexpr (std::is_same_v<Value, int>) return whole_type;
    return std::is_convertible_v<Value, std::optional<double>> ? real_type : word_type;
}

/// The root attributes that both files have.
std::vector<NameInFile> head(std::string_view file) {
    return {{"@format", word_type, scalar, "1", fmt::format("The text \"vibrotrough {}\"", file)},
            {"@schema_version", whole_type, scalar, "1", "Version of this table; a reader refuses others"},
            {"@campaign", word_type, scalar, "1", "Name of the campaign"}};
}

void add(std::vector<NameInFile>& names, std::string const& before, std::string_view type,
         std::string_view shape, Entry const& entry) {
    names.push_back({before + std::string(entry.name), type, shape, entry.units, std::string(entry.meaning)});
}

/// The facts and the values of a case.
void add_case(std::vector<NameInFile>& names, std::string const& before, std::string_view shape) {
    for (Quantity const& quantity : quantities()) {
        if (quantity.is_of_case())
            names.push_back({before + std::string(quantity.name), type_of(quantity.type_of_case()), shape,
                             quantity.units, quantity.meaning_of_case()});
    }
}

void add_packings(std::vector<NameInFile>& names) {
    for (Quantity const& quantity : quantities()) {
        for_packings(quantity, [&](auto const& field) {
            add(names, "packings/", type_of(field), "packings",
                {quantity.name, quantity.units, quantity.meaning});
        });
    }
    for (PackingSeries const& series : packing_series()) {
        bool const ends = series.length == SeriesLength::cycle_ends;
        add(names, ends ? "cycle_ends/<packing>/" : "series/<packing>/", real_type,
            ends ? "cycles + 1" : "cycles", series.entry);
    }
    for (PackingTable const& table : packing_tables())
        add(names, std::string(table.group) + "/<packing>/", real_type, shape_of(table.group), table.entry);
    for (PackingTable const& table : material_tables(measure::most_materials, false))
        add(names, std::string(table.group) + "/<packing>/", real_type, "cycles + 1", table.entry);
    for (PackingTable const& table : material_tables(measure::most_materials, true))
        add(names, std::string(table.group) + "/<packing>/", real_type,
            table.group == "material_flow" ? "materials" : "materials * bins", table.entry);
    for (PackingTable const& table : open_tables(true)) {
        add(names, std::string(table.group) + "/<packing>/", real_type,
            table.group == "flow"    ? "cycles + 1"
            : table.group == "along" ? "bins"
                                     : "101",
            table.entry);
    }
    for (auto const* const tables : {&size_tables(), &batch_tables(), &fed_screen_tables()}) {
        for (PackingTable const& table : *tables)
            add(names, std::string(table.group) + "/<packing>/", real_type,
                table.group == "sizes"         ? "sizes"
                : table.group == "passed"      ? "grains"
                : table.group == "size_cycles" ? "sizes * (cycles + 1)"
                                               : "cycles + 1",
                table.entry);
    }
    for (Entry const& entry : materials_entries())
        add(names, "materials/", entry.name == "name" ? word_type : real_type, "materials", entry);
    for (Entry const& entry : materials_along_entries())
        add(names, "materials_along/", entry.name == "material" ? word_type : real_type, "materials * bins",
            entry);
    for (Entry const& entry : segregation_entries())
        add(names, "segregation/", real_type, "cycles + 1", entry);
    for (Entry const& entry : stages_entries()) add(names, "stages/", real_type, "stages", entry);
    for (Entry const& entry : stage_cycles_entries()) add(names, "stage_cycles/", real_type, "cycles", entry);
    for (Entry const& entry : partition_entries()) add(names, "partition/", real_type, "sizes", entry);
    for (Entry const& entry : screening_entries()) add(names, "screening/", real_type, "cycles + 1", entry);
    for (Entry const& entry : partition_cycles_entries())
        add(names, "partition_cycles/", real_type, "sizes * (cycles + 1)", entry);
    for (Entry const& entry : along_trough_entries()) add(names, "along_trough/", real_type, "bins", entry);
    for (Entry const& entry : residence_times_entries())
        add(names, "residence_times/", real_type, "101", entry);
    for (MassFlowColumn const& column : mass_flow_columns())
        add(names, "mass_flow/", real_type, "slabs", column.entry);
}

std::string table_of(std::vector<NameInFile> const& names) {
    std::string rows = "| name | type | shape | units | meaning |\n|---|---|---|---|---|\n";
    for (auto const& [name, type, shape, units, meaning] : names)
        rows += fmt::format("| `{}` | {} | {} | {} | {} |\n", name, type, shape, units, meaning);
    return rows;
}

}  // namespace

std::vector<NameInFile> names_in_result() {
    std::vector<NameInFile> names = head("result");
    for (CaseFact const& fact : case_facts()) add(names, "@", word_type, scalar, fact.entry);
    for (Entry const& entry : {scenario_entry(), certificate_entry(), scenario_files_entry()})
        add(names, "", word_type, "1", entry);
    add_case(names, "case/", "1");
    add_packings(names);
    return names;
}

std::vector<NameInFile> names_in_campaign() {
    std::vector<NameInFile> names = head("campaign");
    names.push_back({"@swept_keys", word_type, scalar, "1",
                     "Keys of the campaign file that differ between the cases, separated by blanks"});
    names.push_back({"@made_of", word_type, scalar, "1",
                     "Digest of the results and all else that this table was made from"});
    names.push_back(
        {"@program_version", word_type, scalar, "1", "Version of Vibrotrough that wrote this table"});
    names.push_back({"@git_commit", word_type, scalar, "1", "Commit that this Vibrotrough was built from"});
    for (CaseFact const& fact : case_facts()) add(names, "", word_type, "cases", fact.entry);
    add_case(names, "", "cases");
    names.push_back(
        {"swept/<key>", "float64 or text", "cases", "of the key",
         "The values of a key that the campaign sweeps, such as swept/grains.rolling_friction, in "
         "SI units (angles in rad); NaN or empty where a case has none"});
    for (auto const& [name, type, shape, units, meaning] : observable_entries())
        names.push_back(
            {fmt::format("observables/<name>/{}", name), type, shape, units, std::string(meaning)});
    return names;
}

std::string file_reference() {
    // What campaign.h5 has in common with result.h5 is in the first table.
    std::vector<NameInFile> own = names_in_campaign();
    std::erase_if(own, [](NameInFile const& row) {
        return row.shape == "cases" && row.units != "of the key" && !row.name.starts_with("observables/");
    });
    std::string facts;
    for (CaseFact const& fact : case_facts())
        facts += fmt::format("{}`{}`", facts.empty() ? "" : ", ", fact.entry.name);
    return fmt::format(
        "## result.h5\n\n{}\n## campaign.h5\n\n"
        "Each `case/NAME` of result.h5 is a dataset NAME with one value per case, and so is each "
        "root attribute\nof result.h5 that belongs to the case: {}.\n\n{}",
        table_of(names_in_result()), facts, table_of(own));
}

std::vector<OldName> const& old_names() {
    static std::vector<OldName> const names{
        {"speed", "conveying_speed"},
        {"speed_half_width", "conveying_speed_half_width"},
        {"efficiency_dem", "efficiency"},
        {"efficiency_dem_half_width", "efficiency_half_width"},
        {"efficiency_dem_whole_half_width", "efficiency_whole_half_width"},
        {"efficiency_dem_numerical_error", "efficiency_numerical_error"},
        {"speed_dem_m_per_s", "conveying_speed_m_per_s"},
        {"speed_dem_half_width_m_per_s", "conveying_speed_half_width_m_per_s"},
        {"mode_layer", "layer_mode"},
        {"efficiency_normal_force", "efficiency_by_normal_force"},
        {"wall_s", "wall_time_s"},
    };
    return names;
}

std::string_view current_name(std::string_view name) {
    auto const found = std::ranges::find(old_names(), name, &OldName::old);
    return found == old_names().end() ? name : found->name;
}

}  // namespace vibrotrough::store
