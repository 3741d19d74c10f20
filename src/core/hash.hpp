#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vibrotrough::core {

/// SHA-256 (FIPS 180-4) of the bytes, as 64 lower-case hexadecimal digits.
/// @throws std::runtime_error when OpenSSL fails
std::string sha256_hex(std::string_view bytes);

/// SHA-256 of the pieces joined together, as 64 lower-case hexadecimal digits.
/// @throws std::runtime_error when OpenSSL fails
std::string sha256_hex(std::span<std::string_view const> pieces);

}  // namespace vibrotrough::core
