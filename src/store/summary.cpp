#include "store/summary.hpp"

#include "core/error.hpp"
#include "core/hash.hpp"
#include "scenario/model/feed.hpp"
#include "store/hdf5_file.hpp"
#include "store/schema.hpp"

#include <algorithm>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::store {
namespace {

using Json = nlohmann::json;

constexpr std::ptrdiff_t digest_length = 64;  // hexadecimal digits of a SHA-256

std::string digest_of(std::span<std::uint8_t const> bytes) {
    return core::sha256_hex({reinterpret_cast<char const*>(bytes.data()), bytes.size()});
}

/// A value in the form of the files; texts are bytes, because those of other machines need not be UTF-8.
template <typename Value>
Json to_json(Value const& value) {
    auto const stored = to_stored(value);
    if constexpr (std::is_same_v<decltype(stored), std::string const>)
        return Json::binary({stored.begin(), stored.end()});
    else
        return stored;
}

Json to_json(std::optional<measure::Branch> const& branch) {
    if (!branch) return nullptr;
    return Json::array({branch->mean, to_json(branch->half_width), branch->packings});
}

template <typename Value>
void from_json(Json const& json, Value& value) {
    using Stored = decltype(to_stored(value));
    if constexpr (std::is_same_v<Stored, std::string>) {
        auto const& bytes = json.get_binary();
        from_stored(std::string(bytes.begin(), bytes.end()), value);
    } else {
        from_stored(json.get<Stored>(), value);
    }
}

void from_json(Json const& json, std::optional<measure::Branch>& branch) {
    branch.reset();
    if (json.is_null()) return;
    branch.emplace();
    from_json(json.at(0), branch->mean);
    from_json(json.at(1), branch->half_width);
    from_json(json.at(2), branch->packings);
}

/// Applies a function to the pointer to each member of an estimate that a summary holds.
template <typename Function>
void for_estimate(Function const& function) {
    using E = measure::CaseEstimate;
    auto const all = [&](auto... members) { (function(members), ...); };
    all(&E::mean, &E::half_width, &E::packings, &E::deviation, &E::deviation_within, &E::correlation_time,
        &E::drift, &E::below, &E::above);
}

/// Applies a function to the field of each quantity of packings that a summary holds.
template <typename Function>
void for_summary(Function const& function) {
    for (Quantity const& quantity : quantities())
        if (quantity.name != "deck") for_packings(quantity, function);  // long, and in no table of cases
}

/// How many grains were fed in all, by which evaluate::unsteady_flow knows how far chance moves the flows of
/// an open trough; empty of other layers.
std::vector<double> fed_in_all(PackingRecord const& packing, scenario::Scenario const& scenario) {
    std::vector<double> const& fed = packing.series.open.fed;
    if (fed.empty() || !scenario::is_open(scenario)) return {};
    return {fed.back()};
}

Json packing_json(PackingRecord const& packing, scenario::Scenario const& scenario) {
    Json values = Json::array();
    for_summary([&](auto const& field) { values.push_back(to_json(field(packing))); });
    values.push_back(fed_in_all(packing, scenario));
    return values;
}

PackingRecord summary_of_packing(PackingRecord const& packing, scenario::Scenario const& scenario) {
    PackingRecord summary{};
    for_summary([&](auto const& field) { field(summary) = field(packing); });
    summary.series.open.fed = fed_in_all(packing, scenario);
    return summary;
}

PackingRecord packing_from(Json const& values) {
    PackingRecord packing{};
    std::size_t at = 0;
    for_summary([&](auto const& field) { from_json(values.at(at++), field(packing)); });
    packing.series.open.fed = values.at(at).get<std::vector<double>>();
    return packing;
}

CaseRecord record_from(Json const& summary, scenario::Scenario const& scenario) {
    CaseRecord record{};
    record.scenario = scenario;
    Json const& facts = summary.at(0);
    std::size_t at = 0;
    for (CaseFact const& fact : case_facts())
        std::visit([&](auto const& field) { from_json(facts.at(at++), field(record)); }, fact.field);
    Json const& estimate = summary.at(1);
    at = 0;
    for_estimate([&](auto member) { from_json(estimate.at(at++), record.estimate.*member); });
    for (Json const& packing : summary.at(2)) record.packings.push_back(packing_from(packing));
    return record;
}

}  // namespace

CaseRecord summary_of(CaseRecord const& record) {
    CaseRecord summary{};
    summary.scenario = record.scenario;
    for (CaseFact const& fact : case_facts())
        std::visit([&](auto const& field) { field(summary) = field(record); }, fact.field);
    for_estimate([&](auto member) { summary.estimate.*member = record.estimate.*member; });
    for (PackingRecord const& packing : record.packings)
        summary.packings.push_back(summary_of_packing(packing, record.scenario));
    return summary;
}

std::vector<std::uint8_t> pack_summary(CaseRecord const& record) {
    Json facts = Json::array(), estimate = Json::array(), packings = Json::array();
    for (CaseFact const& fact : case_facts())
        std::visit([&](auto const& field) { facts.push_back(to_json(field(record))); }, fact.field);
    for (PackingRecord const& packing : record.packings)
        packings.push_back(packing_json(packing, record.scenario));
    for_estimate([&](auto member) { estimate.push_back(to_json(record.estimate.*member)); });
    std::vector<std::uint8_t> const cbor =
        Json::to_cbor(Json::array({std::move(facts), std::move(estimate), std::move(packings)}));
    std::string const digest = digest_of(cbor);
    std::vector<std::uint8_t> bytes(digest.begin(), digest.end());
    bytes.insert(bytes.end(), cbor.begin(), cbor.end());
    return bytes;
}

std::string digest_of_summary(CaseRecord const& record) {
    auto const packed = pack_summary(record);
    return std::string(packed.begin(), packed.begin() + digest_length);
}

CaseRecord unpack_summary(std::span<std::uint8_t const> bytes, scenario::Scenario const& scenario) {
    // The library's reader of CBOR calls itself for every level of nesting, and damaged bytes could overflow
    // the stack. The digest guards against damage, not against an author of bytes with a right digest.
    std::size_t const start = std::min<std::size_t>(bytes.size(), digest_length);
    auto const cbor = bytes.subspan(start);
    if (!std::ranges::equal(bytes.first(start), digest_of(cbor)))
        throw core::InputError("a summary of a result is damaged (its digest does not match)");
    try {
        return record_from(Json::from_cbor(cbor.begin(), cbor.end()), scenario);
    } catch (Json::exception const& error) {
        throw core::InputError(fmt::format("a summary of a result is damaged ({})", error.what()));
    } catch (Hdf5Error const& error) {
        throw core::InputError(fmt::format("a summary of a result is damaged ({})", error.what()));
    }
}

std::string summary_layout() {
    std::string layout = "summary";
    for (CaseFact const& fact : case_facts()) layout += " " + std::string(fact.entry.name);
    for (Quantity const& quantity : quantities())
        if (quantity.is_of_packings()) layout += " " + std::string(quantity.name);
    return layout + " fed";
}

}  // namespace vibrotrough::store
