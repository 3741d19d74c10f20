#include "store/reference.hpp"

#include "store/observable.hpp"
#include "store/schema.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace vibrotrough::store {
namespace {

constexpr std::string_view real_type = "float64", whole_type = "int32", word_type = "text", scalar = "scalar";

std::string_view type_of(CaseNumber const& value) {
    return std::array{whole_type, real_type, word_type}.at(value.index());
}

/// The type of a field of packings in the files.
template <typename Value>
std::string_view type_of(Field<PackingRecord, Value> const& /*field*/) {
    if constexpr (std::is_same_v<Value, int>) return whole_type;
    return std::is_convertible_v<Value, std::optional<double>> ? real_type : word_type;
}

/// The type of what the theory says of a case.
template <typename Value>
std::string_view type_of_case(Field<CaseRecord, Value> const& /*field*/) {
    return std::is_same_v<Value, std::string> ? word_type : real_type;
}

/// The root attributes that both files have.
std::vector<NameInFile> head(std::string_view file) {
    return {{"@format", word_type, scalar, "1", fmt::format("The text \"vibrotrough {}\"", file)},
            {"@schema_version", whole_type, scalar, "1", "Version of this table; a reader refuses others"},
            {"@campaign", word_type, scalar, "1", "Name of the campaign"}};
}

void add(std::vector<NameInFile>& names, std::string const& before, std::string_view type,
         std::string_view shape, Entry const& entry) {
    names.push_back({before + entry.name, type, shape, entry.units, entry.meaning});
}

/// The facts and the values of a case.
void add_case(std::vector<NameInFile>& names, std::string const& before, std::string_view shape) {
    for (Quantity const& quantity : quantities()) {
        if (quantity.is_of_case())
            names.push_back({before + std::string(quantity.name), type_of(quantity.type_of_case()), shape,
                             std::string(quantity.units), quantity.meaning_of_case()});
    }
}

void add_packings(std::vector<NameInFile>& names) {
    for (Quantity const& quantity : quantities()) {
        for_packings(quantity, [&](auto const& field) {
            names.push_back({"packings/" + std::string(quantity.name), type_of(field), "packings",
                             std::string(quantity.units), std::string(quantity.meaning)});
        });
    }
    for (PackingTable const& table : packing_tables())
        for (PackingColumn const& column : table.columns)
            add(names, fmt::format("{}/<packing>/", table.name), real_type, table.rows, column.entry);
    for (CaseTable const& table : case_tables())
        for (Entry const& entry : table.columns)
            add(names, fmt::format("{}/", table.name), entry.name == table.text ? word_type : real_type,
                table.rows, entry);
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
    for (Entry const& entry : {scenario_entry, certificate_entry, scenario_files_entry})
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
    for (CaseTheoryColumn const& one : case_theory_columns())
        std::visit([&](auto const& field) { add(names, "", type_of_case(field), "cases", one.entry); },
                   one.field);
    names.push_back(
        {"swept/<key>", "float64 or text", "cases", "of the key",
         "The values of a key that the campaign sweeps, such as swept/grains.rolling_friction, in "
         "SI units (angles in rad); NaN or empty where a case has none"});
    for (auto const& [name, type, shape, units, meaning] : observable_entries())
        names.push_back({fmt::format("observables/<name>/{}", name), type, shape, std::string(units),
                         std::string(meaning)});
    return names;
}

std::string file_reference() {
    // What campaign.h5 has in common with result.h5 is in the first table.
    std::vector<NameInFile> own = names_in_campaign();
    auto const is_of_theory = [](NameInFile const& row) {
        return std::ranges::any_of(case_theory_columns(),
                                   [&](auto const& one) { return one.entry.name == row.name; });
    };
    std::erase_if(own, [&](NameInFile const& row) {
        return row.shape == "cases" && row.units != "of the key" && !row.name.starts_with("observables/") &&
               !is_of_theory(row);
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
        {"efficiency_dem_half_width", "efficiency_half_width_statistics"},
        {"efficiency_dem_whole_half_width", "efficiency_half_width"},
        {"efficiency_whole_half_width", "efficiency_half_width"},
        {"efficiency_dem_numerical_error", "efficiency_numerics"},
        {"efficiency_numerical_error", "efficiency_numerics"},
        {"efficiency_below_half_width", "efficiency_below_half_width_statistics"},
        {"efficiency_above_half_width", "efficiency_above_half_width_statistics"},
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
