#include "store/result_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/note.hpp"
#include "core/version.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "store/hdf5_file.hpp"
#include "store/schema.hpp"

#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::store {
namespace {

constexpr char const* result_format = "vibrotrough result";
constexpr char const* campaign_format = "vibrotrough campaign";

using Tables = std::map<std::string, Hdf5Table>;

Hdf5Table const& find(Tables const& tables, std::string const& path) {
    auto const found = tables.find(path);
    if (found == tables.end()) throw Hdf5Error("find the dataset " + path);
    return found->second;
}

/// The value of each record in the form that the files store.
template <typename Record, typename Function>
Values stored_values(std::span<Record const> records, Function const& value_of) {
    std::vector<decltype(to_stored(value_of(records.front())))> values;
    values.reserve(records.size());
    for (Record const& record : records) values.push_back(to_stored(value_of(record)));
    return values;
}

/// The values of cases.
Values stored_values(Quantity const& quantity, std::span<CaseRecord const> cases) {
    return std::visit(
        [&]<typename Type>(Type const&) {
            return stored_values(
                cases, [&](CaseRecord const& one) { return std::get<Type>(quantity.of_case(one)); });
        },
        quantity.type_of_case());
}

/// The path of a table of one packing.
std::string packing_path(std::string_view group, std::size_t packing) {
    return fmt::format("{}/{}", group, packing + 1);
}

/// Reads one quantity of all packings.
void read_column(Hdf5Table const& table, Quantity const& quantity, std::vector<PackingRecord>& packings) {
    std::string const name(quantity.name);
    for_packings(quantity, [&](auto const& field) {
        using Stored = decltype(to_stored(field(packings.front())));
        auto const values = table.values<Stored>(name);
        for (std::size_t i = 0; i < values.size(); ++i) from_stored(values[i], field(packings[i]));
    });
}

void read_packings(Tables const& tables, std::vector<PackingRecord>& packings) {
    Hdf5Table const& table = find(tables, "packings");
    packings.resize(table.rows());
    for (Quantity const& quantity : quantities()) read_column(table, quantity, packings);
}

/// Reads the tables of a packing. A column that is not there is empty.
void read_tables(Tables const& tables, std::size_t number, scenario::Scenario const& scenario,
                 PackingRecord& packing) {
    for (PackingTable const& one : packing_tables()) {
        if (!one.is_of(scenario)) continue;
        Hdf5Table const& table = find(tables, packing_path(one.name, number));
        for (PackingColumn const& column : one.columns)
            if (table.has(column.entry.name)) column.field(packing) = table.values<double>(column.entry.name);
    }
}

void check_series(PackingRecord const& packing, std::size_t number) {
    if (packing.series.x.size() != packing.series.normal_force.size() + 1)
        throw Hdf5Error("use the table " + packing_path("cycle_ends", number) + ", its length is wrong");
}

/// Reads `case`, of which only the estimate is not in the scenario or the packings.
measure::CaseEstimate read_case_values(Tables const& tables) {
    Hdf5Table const& table = find(tables, "case");
    if (table.rows() != 1) throw Hdf5Error("use the table case, it has not one row");
    measure::CaseEstimate estimate{};
    from_stored(table.values<double>("efficiency").front(), estimate.mean);
    from_stored(table.values<double>("efficiency_half_width_statistics").front(), estimate.half_width);
    estimate.packings = table.values<int>("packings").front();
    auto const number = [&](char const* name) {
        std::optional<double> value;
        from_stored(table.values<double>(name).front(), value);
        return value;
    };
    estimate.deviation = number("packing_deviation");
    estimate.deviation_within = number("packing_deviation_within").value_or(0);
    estimate.correlation_time = number("correlation_time").value_or(1);
    // Older results do not have it.
    if (table.has("efficiency_drift")) estimate.drift = number("efficiency_drift").value_or(0);
    int const below = (estimate.packings + 1) / 2;  // odd numbers
    if (auto const mean = number("efficiency_below"))
        estimate.below = measure::Branch{*mean, number("efficiency_below_half_width_statistics"), below};
    if (auto const mean = number("efficiency_above")) {
        estimate.above = measure::Branch{*mean, number("efficiency_above_half_width_statistics"),
                                         estimate.packings - below};
    }
    return estimate;
}

void add_tables(Hdf5Writer& file, std::size_t number, scenario::Scenario const& scenario,
                PackingRecord const& packing) {
    for (PackingTable const& one : packing_tables()) {
        if (!one.is_of(scenario)) continue;
        std::size_t rows = 0;
        for (PackingColumn const& column : one.columns) rows = std::max(rows, column.field(packing).size());
        std::vector<Hdf5Column> columns;
        for (auto const& [entry, field] : one.columns)
            if (rows == 0 || !field(packing).empty())
                columns.push_back({entry.name, entry.units, entry.meaning, field(packing)});
        file.table(packing_path(one.name, number), columns);
    }
}

/// The quantities of the table `case`, with meanings that last as long as the program.
std::vector<std::pair<Quantity const*, std::string>> const& case_columns() {
    static std::vector<std::pair<Quantity const*, std::string>> const columns = [] {
        std::vector<std::pair<Quantity const*, std::string>> all;
        for (Quantity const& one : quantities())
            if (one.is_of_case()) all.emplace_back(&one, one.meaning_of_case());
        return all;
    }();
    return columns;
}

std::vector<Hdf5Column> row_of_case(CaseRecord const& record) {
    std::vector<Hdf5Column> columns;
    for (auto const& [one, meaning] : case_columns())
        columns.push_back({one->name, one->units, meaning, stored_values(*one, std::span(&record, 1))});
    return columns;
}

std::vector<Hdf5Column> packings_table(CaseRecord const& record) {
    std::vector<Hdf5Column> columns;
    for (Quantity const& one : quantities()) {
        for_packings(one, [&](auto const& field) {
            columns.push_back({one.name, one.units, one.meaning,
                               stored_values(std::span<PackingRecord const>(record.packings), field)});
        });
    }
    return columns;
}

void check_kind(Hdf5Reader const& file, std::filesystem::path const& path) {
    auto const version = file.whole_number("schema_version");
    if (version && *version < result_schema_version) {
        throw core::InputError(fmt::format(
            "{} was written by an older version of Vibrotrough (schema {}; this one reads {}); 'vibrotrough "
            "run' writes it again from its packings, without the engine",
            path.string(), *version, result_schema_version));
    }
    if (!version || file.text("format") != result_format) {
        throw core::InputError(
            fmt::format("{} is not a result of Vibrotrough (its root attribute "
                        "'format' is not '{}'); give the result.h5 of a case",
                        path.string(), result_format));
    }
    if (*version == result_schema_version) return;
    throw core::InputError(fmt::format(
        "{} was written by a newer Vibrotrough ({}, schema {}; this one reads {}); use that version",
        path.string(), file.text("program_version"), *version, result_schema_version));
}

CaseRecord read_record(Hdf5Reader const& reader, std::filesystem::path const& path) {
    CaseRecord record{};
    for (CaseFact const& fact : case_facts()) {
        std::string const text = reader.text(fact.entry.name);
        std::visit([&](auto const& field) { from_stored(text, field(record)); }, fact.field);
    }
    Tables const file = reader.read_all();
    auto const text = [&file](Entry const& entry) {
        return find(file, entry.name).values<std::string>("").at(0);
    };
    record.scenario_toml = text(scenario_entry);
    record.provenance.engine_certificate = text(certificate_entry);
    record.estimate = read_case_values(file);
    read_packings(file, record.packings);
    scenario::FileSource source;
    auto const files = core::note::parse(text(scenario_files_entry));
    for (auto const& [name, content] : files.items())
        source.files.push_back({name, core::note::text(files, name)});
    record.scenario =
        scenario::parse_campaign(record.scenario_toml, path.string() + ":/scenario", source).cases.front();
    for (std::size_t i = 0; i < record.packings.size(); ++i) {
        read_tables(file, i, record.scenario, record.packings[i]);
        check_series(record.packings[i], i);
    }
    return record;
}

/// The files that the scenario names, as JSON. Bytes that are not UTF-8 cannot be in JSON and are replaced;
/// files whose numbers could be read have none.
std::string files_as_json(scenario::Scenario const& scenario) {
    nlohmann::json files = nlohmann::json::object();
    for (scenario::NamedFile const& file : named_files(scenario)) files[file.name] = file.content;
    return files.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// A table that follows from the packings, if the case has it.
void add_case_table(Hdf5Writer& file, CaseTable const& table, CaseRecord const& record) {
    std::vector<CaseValues> const values = table.values(record);
    std::vector<Hdf5Column> columns;
    for (std::size_t i = 0; i < values.size(); ++i) {
        Entry const& entry = table.columns[i];
        std::visit(
            [&](auto const& list) {
                columns.push_back({entry.name, entry.units, entry.meaning, list});
            },
            values[i]);
    }
    if (!columns.empty()) file.table(std::string(table.name), columns);
}

void fill_result(Hdf5Writer& file, CaseRecord const& record) {
    file.attribute("format", result_format);
    file.attribute("schema_version", result_schema_version);
    file.attribute("campaign", record.scenario.campaign);
    for (CaseFact const& fact : case_facts()) {
        std::visit([&](auto const& field) { file.attribute(fact.entry.name, to_stored(field(record))); },
                   fact.field);
    }
    auto const put = [&file](Entry const& entry, std::string const& text) {
        file.dataset(entry.name, std::vector<std::string>{text}, entry.units, entry.meaning);
    };
    put(scenario_entry, record.scenario_toml);
    put(certificate_entry, record.provenance.engine_certificate);
    put(scenario_files_entry, files_as_json(record.scenario));
    file.table("case", row_of_case(record));
    file.table("packings", packings_table(record));
    for (CaseTable const& table : case_tables()) add_case_table(file, table, record);
    for (std::size_t i = 0; i < record.packings.size(); ++i)
        add_tables(file, i, record.scenario, record.packings[i]);
}

std::string names_of(scenario::SweptKeys const& swept) {
    std::string names;
    for (scenario::Key const* const key : swept)
        names += fmt::format("{}{}", names.empty() ? "" : " ", key->path);
    return names;
}

/// The values of a swept key, NaN or an empty text where a case has none.
Values swept_values(scenario::Key const& key, std::span<CaseRecord const> cases) {
    if (has_words(key)) {
        return stored_values(
            cases, [&](CaseRecord const& one) { return word_of(one.scenario, key.path).value_or(""); });
    }
    return stored_values(cases, [&](CaseRecord const& one) { return number_of(one.scenario, key.path); });
}

void fill_campaign(Hdf5Writer& file, CampaignContent const& content) {
    auto const& [campaign, cases, swept, observables, made_of] = content;
    file.attribute("format", campaign_format);
    file.attribute("schema_version", campaign_schema_version);
    file.attribute("campaign", campaign);
    file.attribute("made_of", made_of);
    file.attribute("program_version", std::string(core::program_version()));
    file.attribute("git_commit", std::string(core::program_commit()));
    file.attribute("swept_keys", names_of(swept));
    auto const put = [&file](Entry const& entry, Values const& values, std::string const& group = "") {
        file.dataset(group + entry.name, values, entry.units, entry.meaning);
    };
    for (CaseFact const& fact : case_facts())
        std::visit([&](auto const& field) { put(fact.entry, stored_values(cases, field)); }, fact.field);
    for (auto const& [one, meaning] : case_columns())
        put({std::string(one->name), std::string(one->units), meaning}, stored_values(*one, cases));
    for (CaseTheoryColumn const& one : case_theory_columns())
        std::visit([&](auto const& field) { put(one.entry, stored_values(cases, field)); }, one.field);
    for (scenario::Key const* const key : swept) put(swept_entry(*key), swept_values(*key, cases), "swept/");
    add_observables(file, cases, observables);
}

}  // namespace

void write_result(std::filesystem::path const& path, CaseRecord const& record) {
    write_hdf5(path, [&](Hdf5Writer& file) { fill_result(file, record); });
}

CaseRecord read_result(std::filesystem::path const& path) {
    try {
        Hdf5Reader const file(path);
        check_kind(file, path);
        return read_record(file, path);
    } catch (core::note::Fault const& fault) {
        throw core::InputError(
            fmt::format("{} is damaged (its scenario_files: {}); delete it and run its case again",
                        path.string(), fault.what()));
    } catch (Hdf5Error const& error) {
        throw core::InputError(fmt::format(
            "{} is damaged ({}); delete it, and 'vibrotrough run' writes it again from its packings",
            path.string(), error.what()));
    }
}

void write_campaign(std::filesystem::path const& path, CampaignContent const& content) {
    write_hdf5(path, [&](Hdf5Writer& file) { fill_campaign(file, content); });
}

std::optional<std::string> made_of(std::filesystem::path const& path) {
    try {
        Hdf5Reader const file(path);
        if (file.whole_number("schema_version") != campaign_schema_version) return {};
        file.read_all();  // notices damage
        return file.text("made_of");
    } catch (core::Error const&) {
        return {};
    } catch (Hdf5Error const&) {
        return {};
    }
}

}  // namespace vibrotrough::store
