#include "scenario/reader/keys.hpp"

#include "core/nearest.hpp"
#include "scenario/reader/key_fields.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::scenario {
namespace {

/// Adds the rows of a list, once for each entry that it may have.
void add_entries(std::vector<Key>& all, std::string_view section, std::span<Key const> rows) {
    static std::deque<std::string> paths;  // a deque, so that earlier paths stay where they are
    for (std::size_t entry = 0; entry < most_entries(section); ++entry) {
        for (Key key : rows) {
            key.path = paths.emplace_back(path_of_entry(section, entry, key.path));
            key.entry = entry;
            all.push_back(key);
        }
    }
}

/// All rows that describe cases, in one list.
std::vector<Key> const& table() {
    static std::vector<Key> const rows = [] {
        std::vector<Key> all;
        auto const add = [&](std::span<Key const> part) { all.insert(all.end(), part.begin(), part.end()); };
        add(trough_keys());
        add(grains_keys());
        add_entries(all, materials_section, material_keys());
        add_entries(all, pairs_section, pair_keys());
        add_entries(all, stages_section, stage_keys());
        add(plan_keys());
        return all;
    }();
    return rows;
}

}  // namespace

std::span<Key const> all_keys() {
    return table();
}

Key const* find_key(std::string_view path) {
    static std::map<std::string_view, Key const*> const by_path = [] {
        std::map<std::string_view, Key const*> found;
        for (Key const& key : table()) found.emplace(key.path, &key);
        return found;
    }();
    auto const found = by_path.find(path);
    return found == by_path.end() ? nullptr : found->second;
}

bool is_optional(Key const& key) {
    return key.if_missing != IfMissing(KeyNeed::required);
}

bool has_words(Key const& key) {
    return key.kind == KeyKind::choice || key.kind == KeyKind::file || key.kind == KeyKind::files;
}

bool can_vary(Key const& key) {
    return key.kind == KeyKind::quantity || key.kind == KeyKind::number || key.kind == KeyKind::integer ||
           has_words(key);
}

std::string_view section_of(Key const& key) {
    return key.path.substr(0, key.path.rfind('.'));
}

bool is_list_section(std::string_view section) {
    return most_entries(section) > 0;
}

std::size_t most_entries(std::string_view section) {
    if (section == materials_section) return most_added_materials;
    if (section == pairs_section) return most_pairs;
    return section == stages_section ? most_stages : 0;
}

std::string path_of_entry(std::string_view section, std::size_t index, std::string_view name) {
    return fmt::format("{}.{}.{}", section, index + 1, name);
}

std::string_view last_name(std::string_view path) {
    return path.substr(path.rfind('.') + 1);
}

std::string write_instead(Key const& key) {
    return fmt::format("write {} = {}", last_name(key.path), key.example);
}

std::string default_text(Key const& key) {
    if (auto const* value = std::get_if<double>(&key.if_missing)) {
        if (key.kind == KeyKind::truth) return *value == 0 ? "false" : "true";
        return fmt::format("{:g}", *value);
    }
    // A file that need not be given has a word for what holds without it, or is simply not there.
    auto const words = choices(key);
    return words.empty() ? "none" : std::string(words.front());
}

std::vector<std::string_view> choices(Key const& key) {
    auto const& words = key.allowed.choices;
    return {words.begin(), std::ranges::find(words, "")};
}

std::string range_of(Key const& key) {
    if (!key.allowed.words.empty()) return std::string(key.allowed.words);
    std::vector<std::string> all;
    for (std::string_view const word : choices(key)) all.emplace_back(word);
    if (!key.allowed.ending.empty())
        all.push_back(fmt::format("a {} file in the same folder{}", key.allowed.ending,
                                  key.kind == KeyKind::files ? ", or a list of at most 30" : ""));
    if (all.empty()) return fmt::format("{:g} to {:g}", key.least, key.most);
    std::string const last = all.back();
    all.pop_back();
    return all.empty() ? last : fmt::format("{} or {}", fmt::join(all, ", "), last);
}

std::string key_reference() {
    std::string text =
        "# All keys of the campaign file\n\nPrinted by `vibrotrough keys`. \"Exactly one of these\" refers "
        "to neighbouring rows.\n\n"
        "| key | example | range | default | meaning |\n|---|---|---|---|---|\n";
    std::vector<Key> all = table();
    all.insert(all.end(), run_keys().begin(), run_keys().end());
    for (Key const& key : all) {
        bool const is_further_entry =
            is_list_section(key.path.substr(0, key.path.find('.'))) && !section_of(key).ends_with(".1");
        if (is_further_entry) continue;
        std::string needed = is_optional(key) ? default_text(key) : "required";
        if (!key.group.empty()) needed = "exactly one of these";
        text += fmt::format("| `{}` | `{}` | {} | {} | {} |\n", key.path, key.example, range_of(key), needed,
                            key.meaning);
    }
    return text;
}

std::string_view nearest_key(std::string_view path) {
    if (path.size() > 64) return {};
    auto const distance = [&](Key const& key) { return core::edit_distance(path, key.path); };
    auto const nearest = std::ranges::min_element(table(), {}, distance);
    return distance(*nearest) <= 4 ? nearest->path : std::string_view{};
}

}  // namespace vibrotrough::scenario
