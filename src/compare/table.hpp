#pragma once

#include "compare/columns.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace vibrotrough::compare {

struct TableStyle {
    std::size_t width = 0;  ///< characters of a line; 0: as wide as need be
    bool colour = false;    ///< ANSI colours for sign and size of the difference, and for failed cases
};

/// The rows as an aligned table for people. Columns that do not fit are left out in the order of their
/// priority, and named in a line below.
std::string to_table(std::vector<Row> const& rows, TableStyle const& style = {},
                     std::span<Column const> columns = all_columns());

}  // namespace vibrotrough::compare
