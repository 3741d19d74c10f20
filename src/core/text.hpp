#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vibrotrough::core {

/// Text from outside, fit for one line of a message: bytes that are no printable ASCII become '?', and what
/// is longer than `longest` bytes is cut and ends in "...".
std::string printable(std::string_view text, std::size_t longest);

}  // namespace vibrotrough::core
