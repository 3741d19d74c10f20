#pragma once

#include "scenario/reader/case_values.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

/// @file
/// Campaign files that are not TOML.

namespace vibrotrough::scenario {

/// Begin and length of a line, which counts from 1.
std::pair<std::size_t, std::size_t> line_at(std::string_view text, unsigned line);

/// Whether a line is one key with its value, so that those around it can be read without it.
bool is_key_with_value(std::string const& line);

/// Says what is wrong with a line that is not TOML: most are numbers as people write them.
/// @param told  what toml++ says of it
/// @throws core::InputError
[[noreturn]] void throw_unreadable(FilePosition const& place, std::string const& line, std::string_view told);

}  // namespace vibrotrough::scenario
