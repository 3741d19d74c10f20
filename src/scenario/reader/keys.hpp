#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

enum class KeyKind {
    name,        ///< of the campaign
    quantity,    ///< a text with a number and a unit
    number,      ///< a plain number
    integer,     ///< a plain whole number
    choice,      ///< one of the words in `range`
    file,        ///< a word in `range`, or the name of a file beside the campaign file
    quantities,  ///< a list of quantities
    numbers,     ///< a list of plain numbers
    harmonics,   ///< a list of "order, ratio, phase"
};

/// One key of the campaign file: what it means, how it is written and what is allowed. The table of all
/// keys is the single source for reading, for errors and for the reference in README.md.
struct Key {
    std::string_view path;  ///< "section.name"
    KeyKind kind;
    std::string_view unit;           ///< SI unit of a quantity, for udunits2; empty otherwise
    double least;                    ///< smallest allowed value, in `unit`
    double most;                     ///< largest allowed value, in `unit`
    std::string_view range;          ///< the same in words, for people; the words of a choice
    std::string_view group;          ///< keys with the same group exclude each other; exactly one is needed
    std::optional<double> fallback;  ///< value when the key is missing; NaN: it may be missing and has none
    std::string_view example;        ///< what to write, right of the equals sign
    std::string_view meaning;
};

/// Whether a case is complete without this key (if it is in no group).
bool is_optional(Key const& key);

/// The words of a choice: "a, b or c" is {a, b, c}.
std::vector<std::string_view> choices(Key const& key);

/// All keys, in the order of the reference.
std::span<Key const> all_keys();

/// The keys of [run] and [run.slurm]: how a campaign is run, not what its cases are. Not among all_keys().
std::span<Key const> run_keys();

/// The key with this path, or nullptr.
Key const* find_key(std::string_view path);

/// The known path nearest to a misspelt one, or an empty text when none is near.
std::string_view nearest_key(std::string_view path);

/// The reference of all keys, those of [run] last, as a Markdown table, as it stands in README.md.
std::string key_reference();

}  // namespace vibrotrough::scenario
