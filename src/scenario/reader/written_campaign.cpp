#include "scenario/reader/written_campaign.hpp"

#include "core/error.hpp"

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
    keys.emplace("grains.shape", "\"sphere\"");  // to_toml leaves this key out for spheres
    return keys;
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
