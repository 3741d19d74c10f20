#pragma once

#include "scenario/reader/case_values.hpp"

#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace vibrotrough::scenario {

/// Line and column at which a node of the campaign file begins.
Position position_of(toml::source_region const& source);

/// A value of the campaign file as its key requires it: numbers in SI units, words, or a list of either.
/// @param file  names the campaign file in errors
/// @throws core::InputError when the value has the wrong type, unit or range
Content read_content(Key const& key, toml::node const& node, std::string const& file);

/// A number in SI units without a check of its range: the step of a range is a difference of two values.
/// @param file  names the campaign file in errors
/// @throws core::InputError when the value has the wrong type or unit
double read_any_number(Key const& key, toml::node const& node, std::string const& file);

}  // namespace vibrotrough::scenario
