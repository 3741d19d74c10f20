#pragma once

#include "compare/columns.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace vibrotrough::compare {

/// How the table for the terminal is printed.
struct TableStyle {
    std::size_t width = 0;  ///< characters per line; 0 for as many as needed
    bool colour = false;    ///< ANSI colours for sign and size of the difference, and for failed cases
};

/// The rows as an aligned table for people. Columns that do not fit are left out, those of least priority
/// first. A line below the table names them.
std::string to_table(std::vector<Row> const& rows, TableStyle const& style = {},
                     std::span<Column const> columns = all_columns());

}  // namespace vibrotrough::compare
