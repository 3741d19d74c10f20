#include "scenario/reader/swept_keys.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::scenario {
namespace {

bool differs(Key const& key, std::vector<Scenario> const& cases) {
    auto const first = key.get(cases.front());
    return std::ranges::any_of(cases, [&](Scenario const& one) { return key.get(one) != first; });
}

/// What a case has for a key, if it is of this type.
template <typename Type>
std::optional<Type> value_as(Scenario const& scenario, std::string_view path) {
    auto const value = key_value(scenario, path);
    auto const* const found = value ? std::get_if<Type>(&*value) : nullptr;
    return found != nullptr ? std::optional(*found) : std::nullopt;
}

}  // namespace

std::optional<Content> key_value(Scenario const& scenario, std::string_view path) {
    Key const* const key = find_key(path);
    return key != nullptr ? key->get(scenario) : std::nullopt;
}

std::optional<double> number_of(Scenario const& scenario, std::string_view path) {
    return value_as<double>(scenario, path);
}

std::optional<std::string> word_of(Scenario const& scenario, std::string_view path) {
    auto const names = value_as<std::vector<std::string>>(scenario, path);
    return names ? fmt::format("{}", fmt::join(*names, ", ")) : value_as<std::string>(scenario, path);
}

SweptKeys swept_keys(std::vector<Key const*> const& candidates, std::vector<Scenario> const& cases) {
    SweptKeys swept;
    for (Key const* const key : candidates) {
        if (std::ranges::find(swept, key) == swept.end() && differs(*key, cases)) swept.push_back(key);
    }
    return swept;
}

ShownUnit shown_unit(Key const& key) {
    if (key.unit == "m") return {1e3, "mm"};
    if (key.unit == "radian") return {180 / std::numbers::pi, "deg"};
    if (key.unit == "Pa") return {1e-6, "MPa"};
    return {1, key.unit};
}

std::string written_value(Key const& key, Content const& value) {
    if (auto const* const word = std::get_if<std::string>(&value)) return *word;
    auto const* const number = std::get_if<double>(&value);
    if (number == nullptr) return "";
    ShownUnit const unit = shown_unit(key);
    double const shown = key.unit == "radian" ? in_degrees(*number) : unit.factor * *number;
    return fmt::format("{:.6g}{}{}", shown, unit.name.empty() ? "" : " ", unit.name);
}

std::string_view short_name(Key const& key) {
    return key.path.starts_with("trough.") ? key.path.substr(key.path.find('.') + 1) : key.path;
}

std::string swept_label(Scenario const& scenario, std::span<Key const* const> keys) {
    std::string label;
    for (Key const* const key : keys) {
        auto const value = key->get(scenario);
        label += fmt::format("{}{} {}", label.empty() ? "" : ", ", short_name(*key),
                             value ? written_value(*key, *value) : "none");
    }
    return label;
}

}  // namespace vibrotrough::scenario
