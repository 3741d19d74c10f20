#include "core/hash.hpp"

#include <array>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>

namespace vibrotrough::core {
namespace {

// Looked up once: OpenSSL reads its lists for it, in each thread that asks before another has the answer.
EVP_MD const* sha256() {
    static std::unique_ptr<EVP_MD, decltype(&EVP_MD_free)> const method(
        EVP_MD_fetch(nullptr, "SHA256", nullptr), EVP_MD_free);
    return method.get();
}

}  // namespace

std::string sha256_hex(std::string_view bytes) {
    return sha256_hex(std::span(&bytes, 1));
}

std::string sha256_hex(std::span<std::string_view const> pieces) {
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> const context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    bool is_well = context && sha256() && EVP_DigestInit_ex(context.get(), sha256(), nullptr) == 1;
    for (std::string_view const piece : pieces)
        is_well = is_well && EVP_DigestUpdate(context.get(), piece.data(), piece.size()) == 1;
    std::array<unsigned char, 32> digest{};
    if (!is_well || EVP_DigestFinal_ex(context.get(), digest.data(), nullptr) != 1)
        throw std::runtime_error("OpenSSL could not compute a SHA-256 digest");
    return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace vibrotrough::core
