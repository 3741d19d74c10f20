#include "scenario/reader/written_campaign.hpp"

#include "core/error.hpp"
#include "core/hash.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// Keys that say how long a case is simulated, and not what. Asked for more, the same packings go on.
constexpr std::array<std::string_view, 4> not_in_identity{"campaign.name", "measure.half_width",
                                                          "measure.max_packings", "measure.max_core_time"};

/// Appends a value as TOML. fmt's "{}" prints the shortest text that reads back as the same double.
struct TomlValue {
    Key const& key;  ///< whose value it is
    std::string& text;

    void operator()(double value) const {
        if (key.kind == KeyKind::truth) {
            text += value == 0 ? "false" : "true";
        } else if (key.unit.empty()) {
            fmt::format_to(std::back_inserter(text), "{}", value);
        } else {
            fmt::format_to(std::back_inserter(text), "\"{} {}\"", value, key.unit);
        }
    }
    void operator()(std::string const& value) const {
        fmt::format_to(std::back_inserter(text), "\"{}\"", value);
    }

    template <typename Element>
    void operator()(std::vector<Element> const& list) const {
        char const* between = "[";
        for (Element const& value : list) {
            text += std::exchange(between, ", ");
            (*this)(value);
        }
        text += "]";
    }
};

/// Appends a line "name = value".
void add_line(std::string& text, std::string_view name, Key const& key, Content const& value) {
    text.append(name).append(" = ");
    std::visit(TomlValue{key, text}, value);
    text += '\n';
}

bool is_default(Key const& key, Content const& value) {
    if (auto const* const word = std::get_if<std::string>(&value)) return *word == default_text(key);
    auto const* const number = std::get_if<double>(&value);
    return number != nullptr && key.if_missing == IfMissing(*number);
}

/// The value that to_toml() writes for a key.
std::optional<Content> written_value(Key const& key, Scenario const& scenario) {
    if (key.access.is_written != nullptr && !key.access.is_written(scenario)) return {};
    auto value = key.get(scenario);
    if (value && key.access.is_left_out_by_default && is_default(key, *value)) value.reset();
    return value;
}

}  // namespace

std::string to_toml(Scenario const& scenario) {
    std::string text;
    std::string_view section;
    for (Key const& key : all_keys()) {
        auto const value = written_value(key, scenario);
        if (!value) continue;
        if (section_of(key) != section) {
            std::string_view const list = section_of(key).substr(0, section_of(key).find('.'));
            bool const is_list = is_list_section(list);
            fmt::format_to(std::back_inserter(text), "{}{}{}{}\n", section.empty() ? "" : "\n",
                           is_list ? "[[" : "[", list, is_list ? "]]" : "]");
            section = section_of(key);
        }
        add_line(text, last_name(key.path), key, *value);
    }
    // Results and hashes of older programs hold the text with an empty line behind this section.
    return section == "engine" ? text + "\n" : text;
}

std::string identity_of(Scenario const& scenario) {
    Scenario canonical = scenario;
    canonical.trough.given = {};
    std::string text;
    for (Key const& key : all_keys()) {
        if (std::ranges::find(not_in_identity, key.path) != std::end(not_in_identity)) continue;
        if (auto const value = written_value(key, canonical)) add_line(text, key.path, key, *value);
    }
    for (NamedFile const& file : named_files(scenario))
        text += fmt::format("{} {}\n", file.name, core::sha256_hex(file.content));
    return text;
}

WrittenKeys keys_of(Scenario const& scenario) {
    WrittenKeys keys;
    for (Key const& key : all_keys()) {
        bool const has_default = key.access.is_left_out_by_default && can_vary(key);
        auto value = has_default ? key.get(scenario) : written_value(key, scenario);
        if (value) keys.emplace(key.path, *std::move(value));
    }
    return keys;
}

std::set<std::string_view> differing_keys(std::vector<WrittenKeys> const& cases) {
    std::set<std::string_view> names;
    for (WrittenKeys const& one : cases) {
        for (auto const& [name, value] : one) {
            auto const first = cases.front().find(name);
            if (first == cases.front().end() || one.size() != cases.front().size()) {
                throw core::InputError(
                    fmt::format("the cases do not all give the same keys ({} is not in all); choose cases "
                                "that give the same keys",
                                name));
            }
            if (first->second != value) names.insert(name);
        }
    }
    return names;
}

std::string campaign_toml(std::vector<Scenario> const& cases, std::string const& comment) {
    std::vector<WrittenKeys> written;
    for (Scenario const& one : cases) written.push_back(keys_of(one));
    std::set<std::string_view> const names = differing_keys(written);
    std::string text = fmt::format("# {}\n{}", comment, to_toml(cases.front()));
    for (WrittenKeys const& one : written) {
        if (names.empty()) break;
        text += "\n[[points]]\n";
        for (std::string_view const path : names)
            add_line(text, fmt::format("\"{}\"", path), *find_key(path), one.at(path));
    }
    return text;
}

}  // namespace vibrotrough::scenario
