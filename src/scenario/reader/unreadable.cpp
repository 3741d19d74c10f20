#include "scenario/reader/unreadable.hpp"

#include <algorithm>
#include <regex>

#include <fmt/format.h>

namespace vibrotrough::scenario {

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
                     fmt::format("'{}' {}", written,
                                 has_comma ? "has a decimal comma" : "is a text without quotes"),
                     unit.empty() ? fmt::format("write {} = {}", key, number)
                                  : fmt::format("write {} = \"{} {}\"", key, number, unit));
    }
    throw_at(place, "TOML", told.substr(0, 300), "write key = value lines under [section] headings");
}

}  // namespace vibrotrough::scenario
