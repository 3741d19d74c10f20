#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::scenario {

template <std::size_t Columns>
struct NumberRow {
    std::array<double, Columns> values;
    int line;  ///< in the text, from 1
};

/// Reads a small CSV of finite numbers below a given header. Empty lines and lines that begin with # are left
/// out; lines may end as on Windows.
/// @param many  how many numbers a line has, in words
/// @throws std::invalid_argument one line that says what is wrong with the text
template <std::size_t Columns>
std::vector<NumberRow<Columns>> read_number_table(std::string_view text, std::string_view header,
                                                  std::string_view many) {
    std::vector<NumberRow<Columns>> rows;
    bool seen_header = false;
    for (int number = 1; !text.empty(); ++number) {
        std::size_t const length = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, length);
        text.remove_prefix(std::min(length + 1, text.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (line.empty() || line.front() == '#') continue;
        if (!seen_header) {
            if (line != header)
                throw std::invalid_argument(fmt::format("line {} is not the header {}", number, header));
            seen_header = true;
            continue;
        }
        NumberRow<Columns> row{{}, number};
        char const* at = line.data();
        char const* const end = at + line.size();
        for (std::size_t column = 0; column < Columns; ++column) {
            auto const [next, failure] = std::from_chars(at, end, row.values[column]);
            bool const last = column + 1 == Columns;
            if (failure != std::errc() || !std::isfinite(row.values[column]) ||
                (last ? next != end : next == end || *next != ',')) {
                throw std::invalid_argument(fmt::format("line {} is not {} numbers", number, many));
            }
            at = next + 1;
        }
        rows.push_back(row);
    }
    return rows;
}

}  // namespace vibrotrough::scenario
