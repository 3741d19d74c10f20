#include "store/summary.hpp"

#include "core/error.hpp"
#include "store/schema.hpp"

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <variant>

namespace vibrotrough::store {
namespace {

/// Long, and in no table.
bool is_long(PackingValue const& value) {
    return value.entry.name == "deck";
}

template <typename Number>
requires std::is_arithmetic_v<Number>
void put(std::string& bytes, Number number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(raw, sizeof number);
}
void put(std::string& bytes, std::string const& text) {
    put(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += text;
}
void put(std::string& bytes, measure::Verdict verdict) {
    put(bytes, static_cast<std::int32_t>(verdict));
}

std::string_view take(std::string_view& bytes, std::size_t size) {
    if (bytes.size() < size) throw core::InputError("a summary of results ends too early");
    std::string_view const part = bytes.substr(0, size);
    bytes.remove_prefix(size);
    return part;
}

template <typename Number>
requires std::is_arithmetic_v<Number>
void get(std::string_view& bytes, Number& number) {
    std::memcpy(&number, take(bytes, sizeof number).data(), sizeof number);
}
void get(std::string_view& bytes, std::string& text) {
    std::uint32_t size = 0;
    get(bytes, size);
    text = std::string(take(bytes, size));
}
void get(std::string_view& bytes, measure::Verdict& verdict) {
    std::int32_t number = 0;
    get(bytes, number);
    if (number < 0 || number > static_cast<std::int32_t>(measure::Verdict::not_steady))
        throw core::InputError("a summary of results holds an unknown verdict");
    verdict = static_cast<measure::Verdict>(number);
}

}  // namespace

CaseRecord summary_of(CaseRecord const& record) {
    std::string const packed = pack_summary(record);
    std::string_view bytes = packed;
    return unpack_summary(bytes, record.scenario);
}

std::string pack_summary(CaseRecord const& record) {
    std::string bytes;
    // The schema's field functions serve reading too and so take a record that may change; this one does not.
    auto& same = const_cast<CaseRecord&>(record);
    for (CaseFact const& fact : case_facts()) put(bytes, fact.field(same));
    put(bytes, record.estimate.mean);
    put(bytes, record.estimate.half_width);
    put(bytes, record.estimate.packings);
    put(bytes, static_cast<std::uint32_t>(record.packings.size()));
    for (PackingRecord& packing : same.packings) {
        for (PackingValue const& value : packing_values()) {
            if (is_long(value)) continue;
            std::visit([&](auto* field) { put(bytes, *field); }, value.field(packing));
        }
    }
    return bytes;
}

CaseRecord unpack_summary(std::string_view& bytes, scenario::Scenario const& scenario) {
    CaseRecord record{};
    record.scenario = scenario;
    for (CaseFact const& fact : case_facts()) get(bytes, fact.field(record));
    get(bytes, record.estimate.mean);
    get(bytes, record.estimate.half_width);
    get(bytes, record.estimate.packings);
    std::uint32_t packings = 0;
    get(bytes, packings);
    if (packings > 1000) throw core::InputError("a summary of results has too many packings");
    record.packings.resize(packings);
    for (PackingRecord& packing : record.packings) {
        for (PackingValue const& value : packing_values()) {
            if (is_long(value)) continue;
            std::visit([&](auto* field) { get(bytes, *field); }, value.field(packing));
        }
    }
    return record;
}

std::string summary_layout() {
    std::string layout = "summary";
    auto const add = [&](Entry const& entry) { layout += " " + std::string(entry.name); };
    for (CaseFact const& fact : case_facts()) add(fact.entry);
    for (PackingValue const& value : packing_values()) add(value.entry);
    return layout;
}

}  // namespace vibrotrough::store
