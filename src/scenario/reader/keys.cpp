#include "scenario/reader/keys.hpp"

#include "core/nearest.hpp"
#include "scenario/reader/key_fields.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// All rows that describe cases, in one list.
std::vector<Key> const& table() {
    static std::vector<Key> const rows = [] {
        std::vector<Key> all;
        for (auto const part : {trough_keys(), grains_keys(), material_keys(), stage_keys(), plan_keys()})
            all.insert(all.end(), part.begin(), part.end());
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

std::string_view path_of_entry(std::string_view section, std::size_t index, std::string_view name) {
    static std::deque<std::string> paths;  // a deque, so that earlier paths stay where they are
    return paths.emplace_back(fmt::format("{}.{}.{}", section, index + 1, name));
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
    bool const has_word = has_words(key) && !key.range.starts_with("a ");
    return has_word ? std::string(choices(key).front()) : "none";
}

std::vector<std::string_view> choices(Key const& key) {
    std::vector<std::string_view> words;
    for (std::string_view rest = key.range; !rest.empty();) {
        std::size_t const end = std::min({rest.find(", "), rest.find(" or "), rest.size()});
        words.push_back(rest.substr(0, end));
        rest.remove_prefix(std::min(rest.size(), end + (rest.substr(end).starts_with(", ") ? 2 : 4)));
    }
    return words;
}

std::string key_reference() {
    std::string text =
        "# All keys of the campaign file\n\nPrinted by `vibrotrough keys`. \"Exactly one of these\" refers "
        "to "
        "neighbouring rows. [src/scenario](README.md)\nexplains how keys work together.\n\n"
        "| key | example | range | default | meaning |\n|---|---|---|---|---|\n";
    std::vector<Key> all = table();
    all.insert(all.end(), run_keys().begin(), run_keys().end());
    for (Key const& key : all) {
        bool const is_further_entry =
            is_list_section(key.path.substr(0, key.path.find('.'))) && !section_of(key).ends_with(".1");
        if (is_further_entry) continue;
        std::string needed = is_optional(key) ? default_text(key) : "required";
        if (!key.group.empty()) needed = "exactly one of these";
        text += fmt::format("| `{}` | `{}` | {} | {} | {} |\n", key.path, key.example, key.range, needed,
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
