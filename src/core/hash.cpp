#include "core/hash.hpp"

#include <array>
#include <stdexcept>

#include <openssl/evp.h>

namespace vibrotrough::core {

struct Sha256::State {
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context{EVP_MD_CTX_new(), EVP_MD_CTX_free};
};

namespace {

[[noreturn]] void fail() {
    throw std::runtime_error("OpenSSL could not compute a SHA-256 digest");
}

}  // namespace

Sha256::Sha256() : state_(std::make_unique<State>()) {
    if (!state_->context || EVP_DigestInit_ex(state_->context.get(), EVP_sha256(), nullptr) != 1) fail();
}

Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes) {
    if (EVP_DigestUpdate(state_->context.get(), bytes.data(), bytes.size()) != 1) fail();
}

std::string Sha256::hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    if (EVP_DigestFinal_ex(state_->context.get(), digest.data(), &size) != 1) fail();
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    text.reserve(2 * size);
    for (unsigned int i = 0; i < size; ++i) {
        text += digits[digest[i] >> 4];
        text += digits[digest[i] & 15];
    }
    return text;
}

std::string sha256_hex(std::string_view bytes) {
    return sha256_hex(std::span(&bytes, 1));
}

std::string sha256_hex(std::span<std::string_view const> pieces) {
    Sha256 digest;
    for (std::string_view const piece : pieces) digest.add(piece);
    return digest.hex();
}

}  // namespace vibrotrough::core
