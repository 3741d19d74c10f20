#include "measure/table_file.hpp"

#include "core/csv.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::measure {
namespace {

std::string header_of(core::CsvReader const& table) {
    return fmt::format("{}", fmt::join(table.columns(), ","));
}

}  // namespace

void parse_table(core::TextFile const& file, TableFormat const& format,
                 std::function<void(int line_number, std::span<double const> row)> const& take) {
    std::string const path = file.path.string();
    // An engine that diverges writes NaN; what that means is decided later.
    core::CsvReader table(
        file.content, path,
        {.comments = true, .blanks = true, .growing = true, .numbers = core::CsvNumbers::any});
    if (table.columns().empty()) return;  // the engine has not written its first line yet
    if (header_of(table) != format.header) {
        throw core::InputError(
            fmt::format("{}:{}: is no table of {}", path, table.header_line(), format.kind));
    }
    std::vector<double> row(table.columns().size());
    long expected_step = format.first_step;
    auto const refuse = [&](int line, std::string const& problem) {
        throw core::InputError(fmt::format("{}:{}: the line is damaged; expected {} numbers for step {} ({})",
                                           path, line, row.size(), expected_step, problem));
    };
    try {
        for (; table.next(row); expected_step += format.step_distance) {
            if (row[0] != static_cast<double>(expected_step))
                refuse(table.line(), fmt::format("step {}", row[0]));
            take(table.line(), row);
        }
    } catch (core::CsvError const& error) {
        refuse(error.line(), error.problem());
    }
}

}  // namespace vibrotrough::measure
