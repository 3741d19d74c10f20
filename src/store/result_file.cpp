#include "store/result_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "store/hdf5_image.hpp"
#include "store/schema.hpp"

#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::store {
namespace {

constexpr char const* result_format = "vibrotrough result";
constexpr char const* campaign_format = "vibrotrough campaign";

/// The value of one CaseValue for every case.
Values column(CaseValue const& value, std::vector<CaseRecord> const& cases) {
    return std::visit(
        [&cases](auto const function) -> Values {
            std::vector<decltype(function(cases.front()))> values;
            for (CaseRecord const& record : cases) values.push_back(function(record));
            return values;
        },
        value.value);
}

/// How a packing's value is stored: as itself, a verdict by its name.
int stored(int value) {
    return value;
}
double stored(double value) {
    return value;
}
std::string stored(std::string const& value) {
    return value;
}
std::string stored(measure::Verdict value) {
    return verdict_name(value);
}

template <typename Value>
void restore(Value const& stored_value, Value& value) {
    value = stored_value;
}
void restore(std::string const& stored_value, measure::Verdict& value) {
    value = verdict_of(stored_value);
}

/// The value of one PackingValue for every packing. (The schema's field functions serve reading too and so
/// take a record that may change.)
Values column(PackingValue const& value, std::vector<PackingRecord>& packings) {
    PackingRecord example{};
    return std::visit(
        [&](auto* const kind) -> Values {
            std::vector<decltype(stored(*kind))> values;
            for (PackingRecord& packing : packings) {
                values.push_back(
                    stored(*std::get<std::remove_const_t<decltype(kind)>>(value.field(packing))));
            }
            return values;
        },
        value.field(example));
}

/// A name of a packing's own table.
std::string packing_path(std::string_view group, std::size_t packing) {
    return fmt::format("{}/{}", group, packing + 1);
}

std::string_view group_of(PackingSeries const& series) {
    return series.length == SeriesLength::cycle_ends ? "cycle_ends" : "series";
}

std::string_view group_of(PackingTable const& table) {
    return table.group;
}

/// Reads one PackingValue of all packings.
void read_column(ImageTable const& table, PackingValue const& value, std::vector<PackingRecord>& packings) {
    PackingRecord example{};
    std::visit(
        [&](auto* const kind) {
            auto const values = table.values<decltype(stored(*kind))>(std::string(value.entry.name));
            for (std::size_t i = 0; i < values.size(); ++i) {
                restore(values[i], *std::get<std::remove_const_t<decltype(kind)>>(value.field(packings[i])));
            }
        },
        value.field(example));
}

void read_packings(ImageReader const& image, std::vector<PackingRecord>& packings) {
    ImageTable const table = image.table("packings", Rank::array);
    packings.resize(table.rows());
    for (PackingValue const& value : packing_values()) read_column(table, value, packings);
}

/// Reads the columns of all tables of a packing.
template <typename Entries>
void read_tables(ImageReader const& image, std::size_t number, PackingRecord& packing,
                 Entries const& entries) {
    std::map<std::string_view, ImageTable> tables;
    for (auto const& entry : entries) {
        auto found = tables.find(group_of(entry));
        if (found == tables.end()) {
            found =
                tables
                    .emplace(group_of(entry), image.table(packing_path(group_of(entry), number), Rank::array))
                    .first;
        }
        entry.field(packing) = found->second.template values<double>(std::string(entry.entry.name));
    }
}

void check_series(PackingRecord const& packing, std::size_t number) {
    if (packing.series.x.size() != packing.series.normal_force.size() + 1)
        throw Hdf5Error("use the table " + packing_path("cycle_ends", number) + ", its length is wrong");
}

/// Reads `case`, of which only the estimate is not in the scenario or the packings.
measure::CaseEstimate read_case_values(ImageReader const& image) {
    ImageTable const table = image.table("case", Rank::scalar);
    return {.mean = table.values<double>("efficiency").front(),
            .half_width = table.values<double>("efficiency_half_width").front(),
            .packings = table.values<int>("packings").front()};
}

template <typename Entries>
void add_tables(ImageWriter& image, std::size_t number, PackingRecord& packing, Entries const& entries) {
    std::vector<std::pair<std::string_view, std::vector<Column>>> tables;
    for (auto const& entry : entries) {
        if (tables.empty() || tables.back().first != group_of(entry)) tables.push_back({group_of(entry), {}});
        auto const& [name, units, meaning] = entry.entry;
        tables.back().second.push_back({name, units, meaning, entry.field(packing)});
    }
    for (auto const& [group, columns] : tables)
        image.table(packing_path(group, number), columns, Rank::array);
}

/// A table of values, one row per record.
template <typename Entries, typename Records>
std::vector<Column> columns_of(Entries const& entries, Records& records) {
    std::vector<Column> columns;
    for (auto const& value : entries) {
        auto const& [name, units, meaning] = value.entry;
        columns.push_back({name, units, meaning, column(value, records)});
    }
    return columns;
}

void check_kind(ImageReader const& image, std::filesystem::path const& path) {
    if (!image.has_attribute("format") || image.text_attribute("format") != result_format) {
        throw core::InputError(
            fmt::format("{} is no result of Vibrotrough (its root attribute 'format' is not '{}'); give the "
                        "result.h5 of a case",
                        path.string(), result_format));
    }
    int const version = image.integer_attribute("schema_version");
    if (version == result_schema_version) return;
    bool const newer = version > result_schema_version;
    throw core::InputError(
        fmt::format("{} was written by {} Vibrotrough ({}, schema {}; this one reads {}); {}", path.string(),
                    newer ? "a newer" : "an older", image.text_attribute("program_version"), version,
                    result_schema_version,
                    newer ? "use that version"
                          : "'vibrotrough run' makes it anew from its packings, without the engine"));
}

CaseRecord read_record(ImageReader const& image, std::filesystem::path const& path) {
    CaseRecord record{};
    for (CaseFact const& fact : case_facts()) {
        fact.field(record) = image.text_attribute(std::string(fact.entry.name));
    }
    record.scenario_toml =
        image.values<std::string>(std::string(scenario_entry().name), Rank::scalar).front();
    record.provenance.engine_certificate =
        image.values<std::string>(std::string(certificate_entry().name), Rank::scalar).front();
    record.estimate = read_case_values(image);
    read_packings(image, record.packings);
    for (std::size_t i = 0; i < record.packings.size(); ++i) {
        read_tables(image, i, record.packings[i], packing_series());
        read_tables(image, i, record.packings[i], packing_tables());
        check_series(record.packings[i], i);
    }
    scenario::FileSource source;
    auto const files = nlohmann::json::parse(
        image.values<std::string>(std::string(scenario_files_entry().name), Rank::scalar).front());
    for (auto const& [name, content] : files.items())
        source.files.push_back({name, content.get<std::string>()});
    record.scenario =
        scenario::parse_campaign(record.scenario_toml, path.string() + ":/scenario", source).cases.front();
    return record;
}

}  // namespace

void write_result(std::filesystem::path const& path, CaseRecord const& record) {
    CaseRecord copy = record;  // see column()
    std::string bytes;
    {
        ImageWriter image;
        image.attribute("format", result_format);
        image.attribute("schema_version", result_schema_version);
        image.attribute("campaign", record.scenario.campaign);
        for (CaseFact const& fact : case_facts()) {
            image.attribute(std::string(fact.entry.name), fact.field(copy));
        }
        auto const put = [&image](std::string const& name, Entry const& entry, Values const& values,
                                  Rank rank) {
            image.dataset(name, values, rank, entry.units, entry.meaning);
        };
        Entry const scenario = scenario_entry();
        put(std::string(scenario.name), scenario, std::vector<std::string>{record.scenario_toml},
            Rank::scalar);
        Entry const certificate = certificate_entry();
        put(std::string(certificate.name), certificate,
            std::vector<std::string>{record.provenance.engine_certificate}, Rank::scalar);
        nlohmann::json files = nlohmann::json::object();
        for (scenario::NamedFile const& file : named_files(record.scenario)) files[file.name] = file.content;
        Entry const scenario_files = scenario_files_entry();
        // Bytes that are no UTF-8 cannot be in JSON; what could be read as numbers has none.
        put(std::string(scenario_files.name), scenario_files,
            std::vector<std::string>{files.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)},
            Rank::scalar);
        std::vector<CaseRecord> const one{record};
        image.table("case", columns_of(case_values(), one), Rank::scalar);
        image.table("packings", columns_of(packing_values(), copy.packings), Rank::array);
        for (std::size_t i = 0; i < copy.packings.size(); ++i) {
            add_tables(image, i, copy.packings[i], packing_series());
            add_tables(image, i, copy.packings[i], packing_tables());
        }
        bytes = image.bytes();
    }
    core::write_file_atomically(path, bytes);
}

CaseRecord read_result(std::filesystem::path const& path) {
    std::string bytes = core::read_file(path);
    try {
        ImageReader const image(std::move(bytes));
        check_kind(image, path);
        return read_record(image, path);
    } catch (nlohmann::json::exception const&) {
        throw core::InputError(
            fmt::format("{} is damaged (its scenario_files are no JSON); delete it and run its case again",
                        path.string()));
    } catch (Hdf5Error const& error) {
        throw core::InputError(
            fmt::format("{} is damaged ({}); delete it and run its case again", path.string(), error.what()));
    }
}

void write_campaign(std::filesystem::path const& path, std::string const& campaign,
                    std::vector<CaseRecord> const& cases) {
    std::vector<CaseRecord> copies = cases;  // see column()
    std::string bytes;
    {
        ImageWriter image;
        image.attribute("format", campaign_format);
        image.attribute("schema_version", campaign_schema_version);
        image.attribute("campaign", campaign);
        image.attribute("program_version", std::string(core::program_version()));
        image.attribute("git_commit", std::string(core::program_commit()));
        for (CaseFact const& fact : case_facts()) {
            std::vector<std::string> texts;
            for (CaseRecord& record : copies) texts.push_back(fact.field(record));
            image.dataset(std::string(fact.entry.name), texts, Rank::array, fact.entry.units,
                          fact.entry.meaning);
        }
        for (CaseValue const& value : case_values()) {
            image.dataset(std::string(value.entry.name), column(value, cases), Rank::array, value.entry.units,
                          value.entry.meaning);
        }
        bytes = image.bytes();
    }
    core::write_file_atomically(path, bytes);
}

}  // namespace vibrotrough::store
