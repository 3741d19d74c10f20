#include "store/file_digest.hpp"

#include "core/hash.hpp"

#include <fmt/format.h>

namespace vibrotrough::store {
namespace {

constexpr std::string_view line_begin = "\nvibrotrough sha256 ";
constexpr std::size_t hex_digits = 64;
constexpr std::size_t line_length = line_begin.size() + hex_digits + 1;

}  // namespace

std::string with_digest(std::string hdf5_file) {
    hdf5_file += fmt::format("{}{}\n", line_begin, core::sha256_hex(hdf5_file));
    return hdf5_file;
}

std::optional<std::string> stated_digest(std::string_view bytes) {
    if (bytes.size() <= line_length) return {};
    std::string_view const line = bytes.substr(bytes.size() - line_length);
    if (!line.starts_with(line_begin) || !line.ends_with('\n')) return {};
    return std::string(line.substr(line_begin.size(), hex_digits));
}

std::optional<std::string> sound_digest(std::string_view bytes) {
    auto stated = stated_digest(bytes);
    if (stated && core::sha256_hex(without_digest(bytes)) != *stated) return {};
    return stated;
}

std::string_view without_digest(std::string_view bytes) {
    return bytes.substr(0, bytes.size() - line_length);
}

}  // namespace vibrotrough::store
