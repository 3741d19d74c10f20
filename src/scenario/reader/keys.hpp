#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace vibrotrough::scenario {

/// How the value of a key is written.
enum class KeyKind {
    name,        ///< of the campaign
    quantity,    ///< a text with a number and a unit
    number,      ///< a plain number
    integer,     ///< a plain whole number
    choice,      ///< one of the words in `range`
    file,        ///< a word in `range`, or the name of a file in the folder of the campaign file
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

/// One key of the campaign file: what it means, how it is written and what is allowed. The table of all
/// keys is the single source for reading, for errors and for the reference in README.md.
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
};

/// Whether a case is complete without this key (if the key is not in a group).
bool is_optional(Key const& key);

/// The words of a choice: "a, b or c" is {a, b, c}.
std::vector<std::string_view> choices(Key const& key);

/// All keys that describe cases, in the order of the reference.
std::span<Key const> all_keys();

/// The keys of the section [run] and of its subsections, which set how a campaign is run and do not change
/// its cases. They are not among all_keys().
std::span<Key const> run_keys();

/// The key of all_keys() with this path, or nullptr.
Key const* find_key(std::string_view path);

/// The path of all_keys() that is most similar to a misspelt one, or an empty text when none is similar (more
/// than four letters to change).
std::string_view nearest_key(std::string_view path);

/// The reference of all keys as a Markdown table, those of [run] last. README.md holds the same table.
std::string key_reference();

}  // namespace vibrotrough::scenario
