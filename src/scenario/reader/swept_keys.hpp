#pragma once

#include "scenario/model/scenario.hpp"
#include "scenario/reader/case_values.hpp"
#include "scenario/reader/keys.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// Keys of the campaign file that differ between cases: those of [sweep] in their order, then those of the
/// lists by name. The keys are those of all_keys() and live as long as the program.
using SweptKeys = std::vector<Key const*>;

/// What a case has for the key of all_keys() with this path, see KeyAccess::get. None when there is no such
/// key.
std::optional<Content> key_value(Scenario const& scenario, std::string_view path);

/// key_value() if it is a number, in SI units.
std::optional<double> number_of(Scenario const& scenario, std::string_view path);

/// key_value() if it is a word, such as "rolling" for grains.rotation.
std::optional<std::string> word_of(Scenario const& scenario, std::string_view path);

/// Those of `candidates` that have different values in the cases, each once.
SweptKeys swept_keys(std::vector<Key const*> const& candidates, std::vector<Scenario> const& cases);

/// The unit in which people read a quantity of this key.
struct ShownUnit {
    double factor;          ///< by which the value in the key's unit is multiplied
    std::string_view name;  ///< such as "mm"; empty for pure numbers and words
};

/// Millimetres for lengths, degrees for angles, MPa for moduli, else the key's own unit.
ShownUnit shown_unit(Key const& key);

/// A value of a key as people write it: "12 mm", "30 deg", "0.05", "rolling".
std::string written_value(Key const& key, Content const& value);

/// The name of a key in labels: "throw_number" of the trough and the layer's and grains' keys in full, such
/// as "grains.friction".
std::string_view short_name(Key const& key);

/// What distinguishes a case from the others: "throw_number 2, grains.rolling_friction 0.05". Empty when
/// nothing is swept.
std::string swept_label(Scenario const& scenario, std::span<Key const* const> keys);

}  // namespace vibrotrough::scenario
