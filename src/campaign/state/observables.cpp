#include "campaign/state/observables.hpp"

#include "campaign/state/notes.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

namespace note = core::note;
using note::Json;

constexpr char const* observables_format = "vibrotrough observables";
constexpr int observables_schema = 1;

std::vector<std::optional<double>> known_numbers(Json const& one, std::string const& key) {
    std::vector<std::optional<double>> numbers;
    for (Json const& value : note::list(one, key)) {
        if (!value.is_null() && !value.is_number())
            throw note::Fault("'" + key + "' is not a list of numbers");
        numbers.push_back(value.is_null() ? std::nullopt : std::optional(value.get<double>()));
    }
    return numbers;
}

store::ObservedCase case_from(Json const& one, bool is_number) {
    store::ObservedCase found{
        note::text(one, "case"),         note::text(one, "result"), {}, note::count(one, "discarded", 0),
        note::count(one, "measured", 0), note::numbers(one, "at"),  {}};
    for (double const number : note::numbers(one, "packings"))
        found.packings.push_back(static_cast<int>(number));
    auto const means = known_numbers(one, "mean"), half_widths = known_numbers(one, "half_width");
    auto const words = note::texts(one, "steadiness");
    std::size_t const points = is_number ? 1 : found.at.size();
    if (means.size() != points || half_widths.size() != points || words.size() != points)
        throw note::Fault("a case has lists of different lengths");
    for (std::size_t i = 0; i < points; ++i) {
        bool const is_known_word = words[i] == "steady" || words[i] == "drifting" || words[i] == "branching";
        if (!is_known_word) throw note::Fault("'steadiness' is not one of its words");
        found.values.push_back({means[i], half_widths[i], words[i]});
    }
    return found;
}

store::Observable observable_from(Json const& one) {
    store::Observable found{
        note::text(one, "name"),   note::text(one, "unit"),          note::text(one, "meaning"),
        note::text(one, "over"),   note::text(one, "over_unit"),     note::text(one, "file"),
        note::text(one, "source"), note::text(one, "source_sha256"), {}};
    if (!store::is_observable_name(found.name)) throw note::Fault("'name' is not that of an observable");
    if (!store::is_plain_unit(found.unit) || (!found.is_number() && !store::is_plain_unit(found.over_unit)))
        throw note::Fault("'unit' is not a unit");
    for (Json const& measured : note::list(one, "cases"))
        found.cases.push_back(case_from(measured, found.is_number()));
    return found;
}

Json describe(store::ObservedCase const& one) {
    Json means = Json::array(), half_widths = Json::array(), words = Json::array();
    for (store::ObservedValue const& value : one.values) {
        means.push_back(core::note::known_or_null(value.mean));
        half_widths.push_back(core::note::known_or_null(value.half_width));
        words.push_back(value.steadiness);
    }
    return {{"case", one.id},
            {"result", one.result},
            {"packings", one.packings},
            {"discarded", one.discarded},
            {"measured", one.measured},
            {"at", one.at},
            {"mean", std::move(means)},
            {"half_width", std::move(half_widths)},
            {"steadiness", std::move(words)}};
}

Json describe(store::Observable const& one) {
    Json cases = Json::array();
    for (store::ObservedCase const& measured : one.cases) cases.push_back(describe(measured));
    return {{"name", one.name},           {"unit", one.unit},
            {"meaning", one.meaning},     {"over", one.over},
            {"over_unit", one.over_unit}, {"file", one.file},
            {"source", one.source},       {"source_sha256", one.sha256},
            {"cases", std::move(cases)}};
}

}  // namespace

std::vector<store::Observable> parse_observables(std::string_view text) {
    Json const json = note::parse_sealed(text);
    if (note::text(json, "format") != observables_format ||
        note::count(json, "schema_version", 0) != observables_schema)
        throw note::Fault("it is of another format or version");
    std::vector<store::Observable> found;
    for (Json const& one : note::list(json, "observables")) {
        found.push_back(observable_from(one));
        if (std::ranges::count(found, found.back().name, &store::Observable::name) > 1)
            throw note::Fault("two observables have one name");
    }
    return found;
}

std::string to_json(std::vector<store::Observable> const& observables) {
    Json list = Json::array();
    for (store::Observable const& one : observables) list.push_back(describe(one));
    Json const json{{"format", observables_format},
                    {"schema_version", observables_schema},
                    {"observables", std::move(list)}};
    return note::sealed(json);
}

std::vector<store::Observable> read_observables(std::filesystem::path const& campaign_folder) {
    std::filesystem::path const path = campaign_folder / observables_file;
    std::error_code missing;
    if (!std::filesystem::is_regular_file(path, missing)) return {};
    try {
        return parse_observables(core::read_file(path, core::largest_note));
    } catch (note::Fault const& fault) {
        throw core::InputError(
            fmt::format("{} is damaged; delete it and run 'vibrotrough observe' again ({})", path.string(),
                        fault.what()));
    }
}

void write_observables(std::filesystem::path const& campaign_folder,
                       std::vector<store::Observable> const& observables) {
    std::vector<store::Observable> all = read_observables(campaign_folder);
    for (store::Observable const& one : observables) {
        auto const known = std::ranges::find(all, one.name, &store::Observable::name);
        known == all.end() ? all.push_back(one) : void(*known = one);
    }
    core::write_file_atomically(campaign_folder / observables_file, to_json(all));
}

}  // namespace vibrotrough::campaign
