#include "measure/table_file.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

bool parse_row(std::string_view line, std::span<double> row) {
    char const* at = line.data();
    char const* const end = line.data() + line.size();
    for (std::size_t column = 0; column < row.size(); ++column) {
        auto const [next, failure] = std::from_chars(at, end, row[column]);
        if (failure != std::errc()) return false;
        bool const last = column + 1 == row.size();
        if (last ? next != end : (next == end || *next != ',')) return false;
        at = next + 1;
    }
    return true;
}

}  // namespace

void parse_table(core::TextFile const& file, TableFormat const& format,
                 std::function<void(int line_number, std::span<double const> row)> const& take) {
    auto const& [path, content] = file;
    std::vector<double> row(static_cast<std::size_t>(std::ranges::count(format.header, ',')) + 1);
    bool seen_header = false;
    int line_number = 0;
    long expected_step = format.first_step;
    for (std::size_t start = 0; start < content.size();) {
        std::size_t const end = content.find('\n', start);
        if (end == std::string::npos) break;  // the engine is still writing this line
        std::string_view const line(content.data() + start, end - start);
        start = end + 1;
        ++line_number;
        if (line.empty() || line.front() == '#') continue;
        if (!seen_header) {
            if (line != format.header) {
                throw core::InputError(
                    fmt::format("{}:{}: is no table of {}", path.string(), line_number, format.kind));
            }
            seen_header = true;
            continue;
        }
        if (!parse_row(line, row) || row[0] != static_cast<double>(expected_step)) {
            throw core::InputError(fmt::format("{}:{}: the line is damaged; expected {} numbers for step {}",
                                               path.string(), line_number, row.size(), expected_step));
        }
        take(line_number, row);
        expected_step += format.step_distance;
    }
}

}  // namespace vibrotrough::measure
