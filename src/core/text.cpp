#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::core {

std::string_view trimmed(std::string_view text) {
    auto const first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

namespace {

/// One character of UTF-8.
struct Character {
    char32_t code;
    std::size_t length;  ///< bytes; 0 when the bytes are not UTF-8
};

/// The first character of a text (RFC 3629).
Character first_of(std::string_view text) {
    auto const lead = static_cast<unsigned char>(text.front());
    std::size_t const length = lead < 0x80   ? 1
                               : lead < 0xc2 ? 0
                               : lead < 0xe0 ? 2
                               : lead < 0xf0 ? 3
                               : lead < 0xf5 ? 4
                                             : 0;
    if (length == 0 || length > text.size()) return {0, 0};
    char32_t code = length == 1 ? lead : lead & (0x7fU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        auto const next = static_cast<unsigned char>(text[i]);
        if ((next & 0xc0U) != 0x80U) return {0, 0};
        code = (code << 6U) | (next & 0x3fU);
    }
    constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    bool const is_surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < least.at(length) || is_surrogate || code > 0x10ffff) return {0, 0};
    return {code, length};
}

/// Control characters, and marks that reorder or hide what is written (Unicode TR 36).
bool is_steering(char32_t code) {
    return (code < 0x20 && code != '\n' && code != '\t') || (code >= 0x7f && code <= 0x9f) ||
           (code >= 0x200b && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
           (code >= 0x2060 && code <= 0x206f) || code == 0x061c || code == 0xfeff;
}

}  // namespace

std::string harmless(std::string_view text) {
    std::string line;
    line.reserve(text.size());
    while (!text.empty()) {
        auto const [code, length] = first_of(text);
        if (length == 0) {
            line += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
        } else if (is_steering(code)) {
            auto const number = static_cast<unsigned>(code);
            line += number < 0x80 ? fmt::format("\\x{:02x}", number) : fmt::format("\\u{:04x}", number);
        } else {
            line += text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return line;
}

std::string without_sign_of_zero(std::string number) {
    bool const is_zero = number.starts_with('-') && number.find('0') != std::string::npos &&
                         number.find_first_not_of("-0.") == std::string::npos;
    if (is_zero) number.erase(0, 1);
    return number;
}

std::string three_digits(std::optional<double> const& value) {
    return value ? without_sign_of_zero(fmt::format("{:.3f}", *value)) : "-";
}

std::string plain_number(double value, int digits) {
    constexpr double most = 1e15;
    std::string const rounded = fmt::format("{:.{}g}", value, digits);
    bool const has_power = rounded.find("e+") != std::string::npos && std::abs(value) < most;
    return has_power ? fmt::format("{:.0f}", std::stod(rounded)) : rounded;
}

}  // namespace vibrotrough::core
