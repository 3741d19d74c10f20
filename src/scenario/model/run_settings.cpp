#include "scenario/model/run_settings.hpp"

#include <algorithm>

namespace vibrotrough::scenario {
namespace {

bool is_letter_or_digit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

}  // namespace

bool is_plain_text(std::string_view text) {
    return std::ranges::all_of(
        text, [](char c) { return is_letter_or_digit(c) || c == '.' || c == '_' || c == '-'; });
}

std::optional<PlainName> PlainName::from(std::string_view text) {
    if (text.empty() || text.size() > 64 || !is_plain_text(text) || !is_letter_or_digit(text.front()))
        return {};
    return PlainName(text);
}

}  // namespace vibrotrough::scenario
