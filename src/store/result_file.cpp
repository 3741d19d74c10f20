#include "store/result_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/note.hpp"
#include "core/version.hpp"
#include "measure/reaction.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "store/hdf5_memory_file.hpp"
#include "store/material_flow_tables.hpp"
#include "store/open_quantities.hpp"
#include "store/schema.hpp"
#include "store/screen_quantities.hpp"
#include "store/stage_quantities.hpp"

#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::store {
namespace {

constexpr char const* result_format = "vibrotrough result";
constexpr char const* campaign_format = "vibrotrough campaign";

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

std::string_view group_of(PackingSeries const& series) {
    return series.length == SeriesLength::cycle_ends ? "cycle_ends" : "series";
}

std::string_view group_of(PackingTable const& table) {
    return table.group;
}

/// Reads one quantity of all packings.
void read_column(Hdf5Table const& table, Quantity const& quantity, std::vector<PackingRecord>& packings) {
    std::string const name(quantity.name);
    if (quantity.may_be_missing && !table.has(name)) return;
    for_packings(quantity, [&](auto const& field) {
        using Stored = decltype(to_stored(field(packings.front())));
        auto const values = table.values<Stored>(name);
        for (std::size_t i = 0; i < values.size(); ++i) from_stored(values[i], field(packings[i]));
    });
}

void read_packings(Hdf5MemoryFileReader const& file, std::vector<PackingRecord>& packings) {
    Hdf5Table const table = file.table("packings", Rank::array);
    packings.resize(table.rows());
    for (Quantity const& quantity : quantities()) read_column(table, quantity, packings);
}

/// Reads the columns of all tables of a packing.
template <typename Entries>
void read_tables(Hdf5MemoryFileReader const& file, std::size_t number, PackingRecord& packing,
                 Entries const& entries) {
    std::map<std::string_view, Hdf5Table> tables;
    for (auto const& entry : entries) {
        std::string_view const group = group_of(entry);
        auto found = tables.find(group);
        if (found == tables.end())
            found = tables.emplace(group, file.table(packing_path(group, number), Rank::array)).first;
        entry.field(packing) = found->second.template values<double>(std::string(entry.entry.name));
    }
}

std::span<PackingTable const> tables_of_materials(scenario::Scenario const& scenario) {
    return material_tables(scenario.materials.size() + 1, is_open(scenario));
}

/// The tables of the packings on a screen. A batch has a time.
std::vector<std::vector<PackingTable> const*> tables_of_screen(scenario::Scenario const& scenario) {
    std::vector<std::vector<PackingTable> const*> tables;
    if (is_screen(scenario)) tables.push_back(&size_tables());
    if (scenario.screen.time) tables.push_back(&batch_tables());
    if (is_fed_screen(scenario)) tables.push_back(&fed_screen_tables());
    return tables;
}

void check_series(PackingRecord const& packing, std::size_t number) {
    if (packing.series.x.size() != packing.series.normal_force.size() + 1)
        throw Hdf5Error("use the table " + packing_path("cycle_ends", number) + ", its length is wrong");
}

/// Reads `case`, of which only the estimate is not in the scenario or the packings.
measure::CaseEstimate read_case_values(Hdf5MemoryFileReader const& file) {
    Hdf5Table const table = file.table("case", Rank::scalar);
    measure::CaseEstimate estimate{};
    from_stored(table.values<double>("efficiency").front(), estimate.mean);
    from_stored(table.values<double>("efficiency_half_width").front(), estimate.half_width);
    estimate.packings = table.values<int>("packings").front();
    auto const number = [&](char const* name) {
        std::optional<double> value;
        from_stored(table.values<double>(name).front(), value);
        return value;
    };
    estimate.deviation = number("packing_deviation");
    estimate.deviation_within = number("packing_deviation_within").value_or(0);
    estimate.correlation_time = number("correlation_time").value_or(1);
    int const below = (estimate.packings + 1) / 2;  // odd numbers
    if (auto const mean = number("efficiency_below"))
        estimate.below = measure::Branch{*mean, number("efficiency_below_half_width"), below};
    if (auto const mean = number("efficiency_above")) {
        estimate.above =
            measure::Branch{*mean, number("efficiency_above_half_width"), estimate.packings - below};
    }
    return estimate;
}

template <typename Entries>
void add_tables(Hdf5MemoryFileWriter& file, std::size_t number, PackingRecord const& packing,
                Entries const& entries) {
    std::vector<std::pair<std::string_view, std::vector<Hdf5Column>>> tables;
    for (auto const& entry : entries) {
        if (tables.empty() || tables.back().first != group_of(entry)) tables.push_back({group_of(entry), {}});
        auto const& [name, units, meaning] = entry.entry;
        tables.back().second.push_back({name, units, meaning, entry.field(packing)});
    }
    for (auto const& [group, columns] : tables) file.table(packing_path(group, number), columns, Rank::array);
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

std::vector<Hdf5Column> case_table(CaseRecord const& record) {
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

void check_kind(Hdf5MemoryFileReader const& file, std::filesystem::path const& path) {
    if (!file.has_attribute("format") || file.text_attribute("format") != result_format) {
        throw core::InputError(
            fmt::format("{} is not a result of Vibrotrough (its root attribute "
                        "'format' is not '{}'); give the result.h5 of a case",
                        path.string(), result_format));
    }
    int const version = file.integer_attribute("schema_version");
    if (version == result_schema_version) return;
    bool const newer = version > result_schema_version;
    throw core::InputError(
        fmt::format("{} was written by {} Vibrotrough ({}, schema {}; this one reads {}); {}", path.string(),
                    newer ? "a newer" : "an older", file.text_attribute("program_version"), version,
                    result_schema_version,
                    newer ? "use that version"
                          : "'vibrotrough run' writes it again from its packings, without the engine"));
}

CaseRecord read_record(Hdf5MemoryFileReader const& file, std::filesystem::path const& path) {
    CaseRecord record{};
    for (CaseFact const& fact : case_facts()) {
        std::string const text = file.text_attribute(std::string(fact.entry.name));
        std::visit([&](auto const& field) { from_stored(text, field(record)); }, fact.field);
    }
    auto const text = [&file](Entry const& entry) {
        return file.values<std::string>(std::string(entry.name), Rank::scalar).front();
    };
    record.scenario_toml = text(scenario_entry());
    record.provenance.engine_certificate = text(certificate_entry());
    record.estimate = read_case_values(file);
    read_packings(file, record.packings);
    for (std::size_t i = 0; i < record.packings.size(); ++i) {
        read_tables(file, i, record.packings[i], packing_series());
        read_tables(file, i, record.packings[i], packing_tables());
        check_series(record.packings[i], i);
    }
    scenario::FileSource source;
    auto const files = core::note::parse(text(scenario_files_entry()));
    for (auto const& [name, content] : files.items())
        source.files.push_back({name, core::note::text(files, name)});
    record.scenario =
        scenario::parse_campaign(record.scenario_toml, path.string() + ":/scenario", source).cases.front();
    for (std::size_t i = 0; i < record.packings.size(); ++i)
        read_tables(file, i, record.packings[i], tables_of_materials(record.scenario));
    for (std::size_t i = 0; is_open(record.scenario) && i < record.packings.size(); ++i)
        read_tables(file, i, record.packings[i], open_tables(record.scenario.trough.mesh != nullptr));
    for (auto const* const tables : tables_of_screen(record.scenario))
        for (std::size_t i = 0; i < record.packings.size(); ++i)
            read_tables(file, i, record.packings[i], *tables);
    for (PackingRecord& packing : record.packings) {  // older files do not have the reaction, but its curves
        if (!packing.motion.added_mass)
            measure::add_reaction(packing.motion, record.scenario.trough.frequency);
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

/// A table that follows from the packings; none when it has no columns.
void add_case_table(Hdf5MemoryFileWriter& file, std::string const& name, std::vector<Entry> const& entries,
                    std::vector<CaseValues> const& values) {
    std::vector<Hdf5Column> columns;
    for (std::size_t i = 0; i < values.size(); ++i) {
        Entry const& entry = entries[i];
        std::visit(
            [&](auto const& list) {
                columns.push_back({entry.name, entry.units, entry.meaning, list});
            },
            values[i]);
    }
    if (!columns.empty()) file.table(name, columns, Rank::array);
}

/// The bytes of result.h5.
std::string result_bytes(CaseRecord const& record) {
    Hdf5MemoryFileWriter file;
    file.attribute("format", result_format);
    file.attribute("schema_version", result_schema_version);
    file.attribute("campaign", record.scenario.campaign);
    for (CaseFact const& fact : case_facts()) {
        std::visit(
            [&](auto const& field) {
                file.attribute(std::string(fact.entry.name), to_stored(field(record)));
            },
            fact.field);
    }
    auto const put = [&file](Entry const& entry, std::string const& text) {
        file.dataset(std::string(entry.name), std::vector<std::string>{text}, Rank::scalar, entry.units,
                     entry.meaning);
    };
    put(scenario_entry(), record.scenario_toml);
    put(certificate_entry(), record.provenance.engine_certificate);
    put(scenario_files_entry(), files_as_json(record.scenario));
    file.table("case", case_table(record), Rank::scalar);
    file.table("packings", packings_table(record), Rank::array);
    measure::MassFlow const flow = mass_flow_of(record);
    std::vector<Hdf5Column> columns;
    for (auto const& [entry, field] : mass_flow_columns())
        columns.push_back({entry.name, entry.units, entry.meaning, flow.*field});
    file.table("mass_flow", columns, Rank::array);
    add_case_table(file, "materials", materials_entries(), materials_table(record));
    add_case_table(file, "materials_along", materials_along_entries(), materials_along_table(record));
    add_case_table(file, "segregation", segregation_entries(), segregation_table(record));
    add_case_table(file, "stages", stages_entries(), stages_table(record));
    add_case_table(file, "stage_cycles", stage_cycles_entries(), stage_cycles_table(record));
    add_case_table(file, "partition", partition_entries(), partition_table(record));
    add_case_table(file, "screening", screening_entries(), screening_table(record));
    add_case_table(file, "partition_cycles", partition_cycles_entries(), partition_cycles_table(record));
    add_case_table(file, "along_trough", along_trough_entries(), along_trough_table(record));
    add_case_table(file, "residence_times", residence_times_entries(), residence_times_table(record));
    for (std::size_t i = 0; i < record.packings.size(); ++i) {
        add_tables(file, i, record.packings[i], packing_series());
        add_tables(file, i, record.packings[i], packing_tables());
        add_tables(file, i, record.packings[i], tables_of_materials(record.scenario));
        if (is_open(record.scenario))
            add_tables(file, i, record.packings[i], open_tables(record.scenario.trough.mesh != nullptr));
        for (auto const* const tables : tables_of_screen(record.scenario))
            add_tables(file, i, record.packings[i], *tables);
    }
    return file.bytes();
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

}  // namespace

std::string campaign_bytes(std::string const& campaign, std::span<CaseRecord const> cases,
                           scenario::SweptKeys const& swept, std::span<Observable const> observables) {
    Hdf5MemoryFileWriter file;
    file.attribute("format", campaign_format);
    file.attribute("schema_version", campaign_schema_version);
    file.attribute("campaign", campaign);
    file.attribute("program_version", std::string(core::program_version()));
    file.attribute("git_commit", std::string(core::program_commit()));
    file.attribute("swept_keys", names_of(swept));
    auto const put = [&file](Entry const& entry, Values const& values, std::string const& group = "") {
        file.dataset(group + std::string(entry.name), values, Rank::array, entry.units, entry.meaning);
    };
    for (CaseFact const& fact : case_facts())
        std::visit([&](auto const& field) { put(fact.entry, stored_values(cases, field)); }, fact.field);
    for (auto const& [one, meaning] : case_columns())
        put({one->name, one->units, meaning}, stored_values(*one, cases));
    for (scenario::Key const* const key : swept) put(swept_entry(*key), swept_values(*key, cases), "swept/");
    add_observables(file, cases, observables);
    return file.bytes();
}

void write_result(std::filesystem::path const& path, CaseRecord const& record) {
    core::write_file_atomically(path, result_bytes(record));
}

CaseRecord read_result(std::filesystem::path const& path) {
    std::string bytes = core::read_file(path);
    try {
        Hdf5MemoryFileReader const file(std::move(bytes));
        check_kind(file, path);
        return read_record(file, path);
    } catch (core::note::Fault const& fault) {
        throw core::InputError(
            fmt::format("{} is damaged (its scenario_files: {}); delete it and run its case again",
                        path.string(), fault.what()));
    } catch (Hdf5Error const& error) {
        throw core::InputError(
            fmt::format("{} is damaged ({}); delete it and run its case again", path.string(), error.what()));
    }
}

void write_campaign(std::filesystem::path const& path, std::string const& campaign,
                    std::vector<CaseRecord> const& cases, scenario::SweptKeys const& swept,
                    std::span<Observable const> observables) {
    core::write_file_atomically(path, campaign_bytes(campaign, cases, swept, observables));
}

CampaignFit fit_of_campaign(std::filesystem::path const& path, scenario::SweptKeys const& swept) {
    try {
        Hdf5MemoryFileReader const file(core::read_file(path));
        if (file.text_attribute("git_commit") != core::program_commit()) return CampaignFit::other_version;
        bool const same_keys =
            file.has_attribute("swept_keys") && file.text_attribute("swept_keys") == names_of(swept);
        return same_keys ? CampaignFit::fits : CampaignFit::other_keys;
    } catch (core::Error const&) {
        return CampaignFit::damaged;
    } catch (Hdf5Error const&) {
        return CampaignFit::damaged;
    }
}

}  // namespace vibrotrough::store
