#include "scenario/reader/unreadable.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <regex>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// The position behind a string of TOML that begins at `at`; an unfinished one on a single line ends there.
std::size_t end_of_string(std::string_view text, std::size_t at) {
    char const quote = text[at];
    std::string const three(3, quote);
    bool const is_long = text.substr(at, 3) == three;
    for (std::size_t i = at + (is_long ? 3 : 1); i < text.size(); ++i) {
        if (text[i] == '\\' && quote == '"') {
            ++i;
        } else if (is_long) {
            if (text.substr(i, 3) != three) continue;
            // The string may itself end with one or two quotes. No more are looked at: a file of nothing but
            // quotes would take a time that grows with the square of its size.
            std::string_view const ending = text.substr(i, 5);
            return i + std::min(ending.find_first_not_of(quote), ending.size());
        } else if (text[i] == quote || text[i] == '\n') {
            return i + 1;
        }
    }
    return text.size();
}

}  // namespace

unsigned line_nested_too_deeply(std::string_view text) {
    constexpr int deepest = 32;  // campaign files need 3
    unsigned line = 1;
    int brackets = 0, dots = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        char const c = text[i];
        if (c == '"' || c == '\'') {
            std::size_t const end = end_of_string(text, i);
            line += static_cast<unsigned>(std::ranges::count(text.substr(i, end - i), '\n'));
            i = end - 1;
            continue;
        }
        if (c == '#') i = std::min(text.find('\n', i), text.size() - 1);
        if (text[i] == '\n') ++line;
        if (std::string_view("=,[]{}\n").find(text[i]) != std::string_view::npos) dots = 0;
        if (c == '[' || c == '{') ++brackets;
        if (c == ']' || c == '}') --brackets;
        if (c == '.') ++dots;
        if (dots > deepest || brackets > deepest) return line;
    }
    return 0;
}

std::pair<std::size_t, std::size_t> line_at(std::string_view text, unsigned line) {
    std::size_t begin = 0;
    for (; line > 1 && begin < text.size(); --line)
        begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
    return {begin, std::min(text.find('\n', begin), text.size()) - begin};
}

bool is_key_with_value(std::string const& line) {
    static std::regex const whole(R"(\s*[A-Za-z_][\w.-]*\s*=[^[\]{}"']*("[^"]*"[^[\]{}"']*)?\s*)");
    return line.size() < 1000 && std::regex_match(line, whole);
}

void throw_unreadable(FilePosition const& place, std::string const& line, std::string_view told) {
    static std::regex const value(
        R"(\s*([A-Za-z_][\w.-]*)\s*=\s*([+-]?[\d.,]*\d)(\s*)([^#"'\s][^#"']*?)?\s*(#.*)?)");
    static std::regex const comma(R"([+-]?\d+,\d+)");
    std::smatch parts;
    if (line.size() < 1000 && std::regex_match(line, parts, value)) {
        std::string const key = parts[1], unit = parts[4];
        std::string number = parts[2];
        std::string const written = number + parts[3].str() + unit;
        bool const has_comma = std::regex_match(number, comma);
        std::ranges::replace(number, ',', '.');
        if (has_comma || !unit.empty())
            throw_at(place, key,
                     fmt::format("'{}' {}", core::harmless(written),
                                 has_comma ? "has a decimal comma" : "is a text without quotes"),
                     unit.empty() ? fmt::format("write {} = {}", key, number)
                                  : fmt::format("write {} = \"{} {}\"", key, number, core::harmless(unit)));
    }
    throw_at(place, "TOML", core::printable(told, 300), "write key = value lines under [section] headings");
}

}  // namespace vibrotrough::scenario
