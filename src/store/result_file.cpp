#include "store/result_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "scenario/campaign_file.hpp"
#include "store/hdf5_image.hpp"
#include "store/schema.hpp"

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

std::string packing_path(std::size_t packing, Entry const& entry) {
    return fmt::format("series/{}/{}", packing + 1, entry.name);
}

std::string packing_path(std::size_t packing, PackingTable const& table) {
    return fmt::format("{}/{}/{}", table.group, packing + 1, table.entry.name);
}

/// Reads one PackingValue of all packings, whose number was read before.
void read_column(ImageReader const& image, PackingValue const& value, std::vector<PackingRecord>& packings) {
    std::string const path = fmt::format("packings/{}", value.entry.name);
    PackingRecord example{};
    std::visit(
        [&](auto* const kind) {
            auto const values = image.values<decltype(stored(*kind))>(path, Rank::array);
            if (values.size() != packings.size())
                throw Hdf5Error("use the dataset " + path + ", its length is wrong");
            for (std::size_t i = 0; i < values.size(); ++i) {
                restore(values[i], *std::get<std::remove_const_t<decltype(kind)>>(value.field(packings[i])));
            }
        },
        value.field(example));
}

void read_series(ImageReader const& image, std::vector<PackingRecord>& packings) {
    for (std::size_t i = 0; i < packings.size(); ++i) {
        for (PackingSeries const& series : packing_series()) {
            series.field(packings[i]) = image.values<double>(packing_path(i, series.entry), Rank::array);
        }
        std::size_t const cycles = packings[i].series.normal_force.size();
        for (PackingSeries const& series : packing_series()) {
            std::size_t const wanted = cycles + (series.length == SeriesLength::cycle_ends ? 1 : 0);
            if (series.field(packings[i]).size() != wanted) {
                throw Hdf5Error("use the dataset " + packing_path(i, series.entry) + ", its length is wrong");
            }
        }
    }
}

void read_tables(ImageReader const& image, std::vector<PackingRecord>& packings) {
    for (std::size_t i = 0; i < packings.size(); ++i) {
        PackingTable const* first = nullptr;
        for (PackingTable const& table : packing_tables()) {
            if (!first || first->group != table.group) first = &table;
            table.field(packings[i]) = image.values<double>(packing_path(i, table), Rank::array);
            if (table.field(packings[i]).size() != first->field(packings[i]).size())
                throw Hdf5Error("use the dataset " + packing_path(i, table) + ", its length is wrong");
        }
    }
}

/// Reads `case/*`, of which only the estimate is not in the scenario or the packings.
measure::CaseEstimate read_case_values(ImageReader const& image) {
    measure::CaseEstimate estimate{};
    for (CaseValue const& value : case_values()) {
        std::string const path = fmt::format("case/{}", value.entry.name);
        if (std::holds_alternative<int (*)(CaseRecord const&)>(value.value)) {
            int const number = image.values<int>(path, Rank::scalar).front();
            if (value.entry.name == "packings") estimate.packings = number;
        } else if (std::holds_alternative<double (*)(CaseRecord const&)>(value.value)) {
            double const number = image.values<double>(path, Rank::scalar).front();
            if (value.entry.name == "efficiency") estimate.mean = number;
            if (value.entry.name == "efficiency_half_width") estimate.half_width = number;
        }
    }
    return estimate;
}

void check_kind(ImageReader const& image, std::filesystem::path const& path) {
    if (!image.has_attribute("format") || image.text_attribute("format") != result_format) {
        throw InputError(
            fmt::format("{} is no result of Vibrotrough (its root attribute 'format' is not '{}'); give the "
                        "result.h5 of a case",
                        path.string(), result_format));
    }
    int const version = image.integer_attribute("schema_version");
    if (version > schema_version) {
        throw InputError(
            fmt::format("{} was written by a newer Vibrotrough ({}, schema {}; this one reads up to {}); use "
                        "that version",
                        path.string(), image.text_attribute("program_version"), version, schema_version));
    }
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
    record.packings.resize(image.length("packings/seed"));
    for (PackingValue const& value : packing_values()) read_column(image, value, record.packings);
    read_series(image, record.packings);
    read_tables(image, record.packings);
    FileSource source;
    auto const files = nlohmann::json::parse(
        image.values<std::string>(std::string(scenario_files_entry().name), Rank::scalar).front());
    for (auto const& [name, content] : files.items())
        source.files.push_back({name, content.get<std::string>()});
    record.scenario =
        parse_campaign(record.scenario_toml, path.string() + ":/scenario", source).cases.front();
    return record;
}

}  // namespace

void write_result(std::filesystem::path const& path, CaseRecord const& record) {
    CaseRecord copy = record;  // see column()
    std::string bytes;
    {
        ImageWriter image;
        image.attribute("format", result_format);
        image.attribute("schema_version", schema_version);
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
        for (NamedFile const& file : named_files(record.scenario)) files[file.name] = file.content;
        Entry const scenario_files = scenario_files_entry();
        // Bytes that are no UTF-8 cannot be in JSON; what could be read as numbers has none.
        put(std::string(scenario_files.name), scenario_files,
            std::vector<std::string>{files.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)},
            Rank::scalar);
        for (CaseValue const& value : case_values()) {
            put(fmt::format("case/{}", value.entry.name), value.entry, column(value, {record}), Rank::scalar);
        }
        for (PackingValue const& value : packing_values()) {
            put(fmt::format("packings/{}", value.entry.name), value.entry, column(value, copy.packings),
                Rank::array);
        }
        for (std::size_t i = 0; i < copy.packings.size(); ++i) {
            for (PackingSeries const& series : packing_series()) {
                put(packing_path(i, series.entry), series.entry, series.field(copy.packings[i]), Rank::array);
            }
            for (PackingTable const& table : packing_tables()) {
                put(packing_path(i, table), table.entry, table.field(copy.packings[i]), Rank::array);
            }
        }
        bytes = image.bytes();
    }
    write_file_atomically(path, bytes);
}

CaseRecord read_result(std::filesystem::path const& path) {
    std::string bytes = read_file(path);
    try {
        ImageReader const image(std::move(bytes));
        check_kind(image, path);
        return read_record(image, path);
    } catch (nlohmann::json::exception const&) {
        throw InputError(
            fmt::format("{} is damaged (its scenario_files are no JSON); delete it and run its case again",
                        path.string()));
    } catch (Hdf5Error const& error) {
        throw InputError(
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
        image.attribute("schema_version", schema_version);
        image.attribute("campaign", campaign);
        image.attribute("program_version", std::string(program_version()));
        image.attribute("git_commit", std::string(program_commit()));
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
    write_file_atomically(path, bytes);
}

}  // namespace vibrotrough::store
