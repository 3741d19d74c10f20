#pragma once

#include "scenario/reader/case_values.hpp"

#include <optional>
#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace vibrotrough::scenario {

/// Line and column at which a node of the campaign file begins.
Position position_of(toml::source_region const& source);

/// The key with this path.
/// @param place   in the campaign file
/// @param advice  what to do when no key is similar to a misspelt one
/// @throws core::InputError when there is no such key
Key const& known_key(std::string_view path, FilePosition place, std::string_view advice);

/// The key with this path, which can be varied. @throws core::InputError when there is none
Key const& varied_key(std::string_view path, FilePosition place);

/// Grains per second, of "500 1/s" or "500 grains/s": in the database of units a grain is a mass, of which no
/// one means so many per second here. None when the text is another quantity.
std::optional<double> grains_per_second(std::string const& text);

/// A value of the campaign file as its key requires it: numbers in SI units, words, or a list of either.
/// @param file  names the campaign file in errors
/// @throws core::InputError when the value has the wrong type, unit or range
Content read_content(Key const& key, toml::node const& node, std::string const& file);

/// A value as it is written in a table or on a command line: "9 mm" or "rolling" without quotes.
/// @throws core::InputError as read_content, without a position in a file
Content read_plain_content(Key const& key, std::string const& text);

/// A number in SI units without a check of its range: the step of a range is a difference of two values.
/// @param file  names the campaign file in errors
/// @throws core::InputError when the value has the wrong type or unit
double read_any_number(Key const& key, toml::node const& node, std::string const& file);

}  // namespace vibrotrough::scenario
