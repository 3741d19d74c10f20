#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vibrotrough::core {

/// SHA-256 of the bytes, as 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

/// The same of several pieces, as if they were one.
std::string sha256_hex(std::span<std::string_view const> pieces);

}  // namespace vibrotrough::core
