#pragma once

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
    choice,      ///< one of the words in `range`
    file,        ///< a word in `range`, or the name of a file in the folder of the campaign file
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

    /// The same for a key that to_toml() writes only under a condition.
    constexpr KeyAccess written_if(bool (*condition)(Scenario const&)) const { return {get, set, condition}; }
    /// The same for a key that to_toml() writes only with another value than the default.
    constexpr KeyAccess unless_default() const { return {get, set, is_written, true}; }
};

/// One key of the campaign file: what it means, how it is written, what is allowed, and where its value is in
/// a case or among the settings of a run. The table of all keys is the single source for reading, writing,
/// sweeps, errors, the reference in keys.md and the schema for editors.
struct Key {
    std::string_view path;     ///< "section.name"
    KeyKind kind;              ///< how its value is written
    std::string_view unit;     ///< SI unit of a quantity, for udunits2; empty otherwise
    double least;              ///< smallest allowed value, in `unit`
    double most;               ///< largest allowed value, in `unit`
    std::string_view range;    ///< the allowed values in words; for a choice, the words themselves
    std::string_view group;    ///< keys with the same group exclude each other; exactly one is needed
    IfMissing if_missing;      ///< for a key without group; keys in a group are `required`
    std::string_view example;  ///< what to write to the right of the equals sign
    std::string_view meaning;  ///< its description in the reference
    KeyAccess access;          ///< how its value is read and written
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

/// The words of a choice: "a, b or c" is {a, b, c}.
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

/// The page keys.md: all keys as a Markdown table, those of [run] last.
std::string key_reference();

}  // namespace vibrotrough::scenario
