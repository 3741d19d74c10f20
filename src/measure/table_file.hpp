#pragma once

#include "core/atomic_file.hpp"

#include <functional>
#include <span>
#include <string_view>

namespace vibrotrough::measure {

/// A table that the engine writes: comment lines, a header, then a line of numbers per step, evenly spaced.
struct TableFormat {
    std::string_view kind;    ///< in words, for errors: "cycles"
    std::string_view header;  ///< names of the columns, the first of them "step"
    long first_step;          ///< step of the first line
    long step_distance;       ///< steps from one line to the next
};

/// Calls `take` with the number of each line and its values. A last line without its end is left out: the
/// engine may be writing it.
/// @throws InputError naming file and line when a line is damaged or a step is missing
void parse_table(core::TextFile const& file, TableFormat const& format,
                 std::function<void(int line_number, std::span<double const> row)> const& take);

}  // namespace vibrotrough::measure
