#include "core/shell.hpp"

#include "core/text.hpp"

#include <fmt/format.h>

namespace vibrotrough::core {

namespace {

/// A word whose characters could steer the terminal on which it is shown, or hide what is written: printf of
/// the shell makes them again when the command is copied. A line end at the very end of a name is
/// lost.
std::string shown_word(std::string const& text) {
    std::string octal;
    for (char const c : text) {
        auto const byte = static_cast<unsigned char>(c);
        bool const is_plain = byte >= ' ' && byte < 0x7f && c != '\\' && c != '%' && c != '\'';
        octal += is_plain ? std::string(1, c) : fmt::format("\\{:03o}", byte);
    }
    return fmt::format("\"$(printf '{}')\"", octal);
}

}  // namespace

std::string shell_word(std::filesystem::path const& path) {
    constexpr char const* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+=:,@%";
    std::string const text = path.string();
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    if (harmless(text) != text) return shown_word(text);
    std::string quoted = "'";
    for (char const c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace vibrotrough::core
