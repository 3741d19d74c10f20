#include "scenario/reader/written_campaign.hpp"

#include "core/error.hpp"
#include "scenario/reader/design.hpp"
#include "scenario/reader/value_reader.hpp"

#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace vibrotrough::scenario {

WrittenKeys keys_of(Scenario const& scenario) {
    WrittenKeys keys;
    toml::table const root = toml::parse(to_toml(scenario));
    for (auto const& [section, content] : root) {
        for (auto const& [key, value] : *content.as_table()) {
            std::ostringstream text;
            value.visit([&](auto const& node) { text << node; });
            keys.emplace(std::string(section.str()) + "." + std::string(key.str()), text.str());
        }
    }
    keys.emplace("grains.shape", "\"sphere\"");  // to_toml leaves these keys out by default
    keys.emplace("engine.contact", "\"hertz\"");
    keys.emplace("engine.cohesion", "\"0 J/m3\"");
    keys.emplace("engine.extra", "\"none\"");
    return keys;
}

namespace {

/// The value that to_toml() writes for a key.
std::optional<Content> written_value(Scenario const& scenario, std::string_view key) {
    Key const* const known = find_key(key);
    if (known == nullptr) return {};
    toml::table const root = toml::parse(to_toml(scenario));
    auto const dot = key.find('.');
    toml::node_view const node = root[key.substr(0, dot)][key.substr(dot + 1)];
    if (!node) return {};
    return read_content(*known, *node.node(), "scenario.toml");
}

}  // namespace

std::optional<double> number_of(Scenario const& scenario, std::string_view key) {
    auto value = written_value(scenario, key);
    if (!value && find_key(key) != nullptr) value = value_of(scenario, {}, key);
    auto const* const number = value ? std::get_if<double>(&*value) : nullptr;
    return number != nullptr ? std::optional(*number) : std::nullopt;
}

std::optional<std::string> word_of(Scenario const& scenario, std::string_view key) {
    auto const value = written_value(scenario, key);
    auto const* const word = value ? std::get_if<std::string>(&*value) : nullptr;
    if (word != nullptr) return *word;
    return key == "grains.shape" ? std::optional<std::string>("sphere") : std::nullopt;
}

std::set<std::string> differing_keys(std::vector<WrittenKeys> const& cases) {
    std::set<std::string> names;
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
    std::set<std::string> const names = differing_keys(written);
    std::string text = fmt::format("# {}\n{}", comment, to_toml(cases.front()));
    for (WrittenKeys const& one : written) {
        if (names.empty()) break;
        text += "\n[[points]]\n";
        for (std::string const& key : names) text += fmt::format("\"{}\" = {}\n", key, one.at(key));
    }
    return text;
}

}  // namespace vibrotrough::scenario
