#pragma once

#include <memory>
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

/// SHA-256 of bytes that come in pieces, such as those of a file that is too long for the memory.
class Sha256 {
  public:
    /// @throws std::runtime_error when OpenSSL fails
    Sha256();
    ~Sha256();
    Sha256(Sha256 const&) = delete;
    Sha256& operator=(Sha256 const&) = delete;

    /// Adds the next bytes. @throws std::runtime_error when OpenSSL fails
    void add(std::string_view bytes);
    /// The digest of all bytes, as 64 lower-case hexadecimal digits. To be called once, at the end.
    /// @throws std::runtime_error when OpenSSL fails
    std::string hex();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace vibrotrough::core
