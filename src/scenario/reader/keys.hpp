#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace vibrotrough::scenario {

struct RunSettings;
struct Scenario;
class GivenValue;

/// The value to the right of an equals sign: a number in SI units, a word, or a list of either, depending on
/// the kind of the key.
using Content = std::variant<double, std::string, std::vector<double>, std::vector<std::string>>;

/// How the value of a key is written.
enum class KeyKind {
    name,        ///< of the campaign
    quantity,    ///< a text with a number and a unit
    number,      ///< a plain number
    integer,     ///< a plain whole number
    choice,      ///< one of some words
    file,        ///< the name of a file in the folder of the campaign file, or one of some words
    files,       ///< the name of a file in the folder of the campaign file, or a list of such names
    quantities,  ///< a list of quantities
    numbers,     ///< a list of plain numbers
    texts,       ///< a list of texts
    truth,       ///< true or false, without quotes; 1 or 0 as a number
    packings,    ///< a list of whole numbers, or the word "all"
};

/// Whether a key without default value has to be given.
enum class KeyNeed {
    required,  ///< a case is incomplete without it, or without another key of its group
    optional,  ///< it may be left out; choices then take their first word, other keys have no value
};

/// The values that a key may have.
struct Allowed {
    std::string_view words = {};                   ///< what the limits do not say; empty where they say it
    std::array<std::string_view, 4> choices = {};  ///< words that may be written; empty behind the last one
    std::string_view ending = {};  ///< of the names of files; empty where no file may be named

    /// In words: "0 to 5" of a number needs none.
    constexpr Allowed(char const* in_words) : words(in_words) {}  // NOLINT(google-explicit-constructor)
    /// These words only, or these words and files with this ending.
    constexpr explicit Allowed(std::array<std::string_view, 4> one_of, std::string_view file_ending = {})
        : choices(one_of), ending(file_ending) {}
};

/// One of these words.
template <typename... Words>
constexpr Allowed one_of(Words... words) {
    return Allowed(std::array<std::string_view, 4>{words...});
}

/// The name of a file with this ending in the folder of the campaign file, or one of these words.
template <typename... Words>
constexpr Allowed file_or(std::string_view ending, Words... words) {
    return Allowed(std::array<std::string_view, 4>{words...}, ending);
}

/// What holds when a key is not given: its default value in SI units, or whether it is needed.
using IfMissing = std::variant<KeyNeed, double>;

/// How the value of a key gets out of a case or the settings of a run, and into them. key_fields.hpp makes it
/// from pointers to members.
struct KeyAccess {
    /// What a case has for the key: given, derived or the default. None when the case has nothing of the
    /// kind, such as a friction of side walls without side walls.
    std::optional<Content> (*get)(Scenario const&) = nullptr;
    /// Puts a given or default value into a case. What follows from several keys is worked out when all are
    /// set (given_values.hpp).
    void (*set)(Scenario&, GivenValue const&) = nullptr;
    /// Whether to_toml() writes the value that a case has; null stands for always.
    bool (*is_written)(Scenario const&) = nullptr;
    /// Whether to_toml() leaves the value out when it is the key's default.
    bool is_left_out_by_default = false;
    /// Puts a given value into the settings of a run, for keys of [run]. The others have get() and set().
    void (*set_run)(RunSettings&, GivenValue const&) = nullptr;
    /// In place of get() and set() of keys of a list such as [[stages]]: they are told which entry it is,
    /// from 0. Setting a value makes the entry.
    std::optional<Content> (*get_entry)(Scenario const&, std::size_t entry) = nullptr;
    void (*set_entry)(Scenario&, std::size_t entry, GivenValue const&) = nullptr;  ///< likewise

    /// The same for a key that to_toml() writes only under a condition.
    constexpr KeyAccess written_if(bool (*condition)(Scenario const&)) const {
        KeyAccess access = *this;
        access.is_written = condition;
        return access;
    }
    /// The same for a key that to_toml() writes only with another value than the default.
    constexpr KeyAccess unless_default() const {
        KeyAccess access = *this;
        access.is_left_out_by_default = true;
        return access;
    }
};

/// One key of the campaign file: what it means, how it is written, what is allowed, and where its value is in
/// a case or among the settings of a run. The table of all keys is the single source for reading, writing,
/// sweeps, errors, the reference of the manual and the schema for editors.
struct Key {
    std::string_view path;     ///< "section.name"
    KeyKind kind;              ///< how its value is written
    std::string_view unit;     ///< SI unit of a quantity, for udunits2; empty otherwise
    double least;              ///< smallest allowed value, in `unit`
    double most;               ///< largest allowed value, in `unit`
    Allowed allowed;           ///< what else than the limits holds
    std::string_view group;    ///< keys with the same group exclude each other; exactly one is needed
    IfMissing if_missing;      ///< for a key without group; keys in a group are `required`
    std::string_view example;  ///< what to write to the right of the equals sign
    std::string_view meaning;  ///< its description in the reference
    KeyAccess access;          ///< how its value is read and written
    std::size_t entry = 0;     ///< of a key of a list: which of its entries it belongs to, from 0

    /// What a case has for it, see KeyAccess::get.
    std::optional<Content> get(Scenario const& scenario) const {
        return access.get_entry != nullptr ? access.get_entry(scenario, entry) : access.get(scenario);
    }
    /// Puts a value into a case.
    void set(Scenario& scenario, GivenValue const& value) const {
        access.set_entry != nullptr ? access.set_entry(scenario, entry, value) : access.set(scenario, value);
    }
};

/// Whether a case is complete without this key (if the key is not in a group).
bool is_optional(Key const& key);

/// Whether the values of a key are words, which have no order: a choice or the name of a file.
bool has_words(Key const& key);

/// Whether a key can be varied: it has a single value and is not the name of the campaign.
bool can_vary(Key const& key);

/// The section of a key, such as "trough", or "materials.1" for the first entry of a list.
std::string_view section_of(Key const& key);

/// The last part of a key's path, without its sections.
std::string_view last_name(std::string_view path);

/// What to write for a key, such as 'write amplitude = "6 mm"'.
std::string write_instead(Key const& key);

/// What is written when a key is not given, such as "0" or "free"; "none" for nothing. Only for optional
/// keys.
std::string default_text(Key const& key);

/// The allowed values in words, such as "0 to 5", "a, b or c".
std::string range_of(Key const& key);

/// The words that may be written, such as {a, b, c}.
std::vector<std::string_view> choices(Key const& key);

/// A section that is a list, [[materials]]. The keys of its entries count them from 1: "materials.2.density".
inline constexpr std::string_view materials_section = "materials";
/// Another one, [[pairs]].
inline constexpr std::string_view pairs_section = "pairs";
/// Another one, [[stages]].
inline constexpr std::string_view stages_section = "stages";

/// How many entries [[materials]] may have: four materials with that of [grains].
inline constexpr std::size_t most_added_materials = 3;
/// How many entries [[pairs]] may have: all pairs of four materials.
inline constexpr std::size_t most_pairs = 6;
/// How many entries [[stages]] may have.
inline constexpr std::size_t most_stages = 16;

/// The path of a key in the entry with this index, such as "materials.1.density": entries count from 1.
std::string path_of_entry(std::string_view section, std::size_t index, std::string_view name);

/// Whether a section is a list.
bool is_list_section(std::string_view section);

/// How many entries a section that is a list may have; 0 for other sections.
std::size_t most_entries(std::string_view section);

/// All keys that describe cases, in the order of the reference and of to_toml().
std::span<Key const> all_keys();

/// The keys of the section [run] and of its subsections, which set how a campaign is run and do not change
/// its cases. They are not among all_keys().
std::span<Key const> run_keys();

/// The key of all_keys() with this path, or nullptr.
Key const* find_key(std::string_view path);

/// The path of all_keys() that is most similar to a path that is none; an empty text when none is similar
/// (more than four letters to change).
std::string_view nearest_key(std::string_view path);

/// The reference of the manual: all keys as a Markdown table, those of [run] last.
std::string key_reference();

}  // namespace vibrotrough::scenario
