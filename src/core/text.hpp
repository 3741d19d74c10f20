#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vibrotrough::core {

/// A text from outside, made suitable for one line of a message: bytes that are not printable ASCII become
/// '?', and a text longer than `longest` bytes is cut there and ends in "...".
std::string printable(std::string_view text, std::size_t longest);

}  // namespace vibrotrough::core
