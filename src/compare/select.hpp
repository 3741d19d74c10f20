#pragma once

#include "compare/columns.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace vibrotrough::compare {

/// Keeps the rows that fulfil a condition such as "throw_number>1.5" or "outcome=finished": a column, one of
/// > >= < <= = == !=, and a value. Columns of text can be compared with = and != only. A value that is not
/// known fulfils no condition.
/// @throws core::InputError when there is no such column or operator, or the value does not suit the column
std::vector<Row> filtered(std::vector<Row> const& rows, std::string_view condition,
                          std::span<Column const> columns = all_columns());

/// Sorts by "COLUMN", "COLUMN:asc" or "COLUMN:desc". Rows that are equal keep their order, and rows whose
/// value is not known come last.
/// @throws core::InputError when there is no such column or order
std::vector<Row> sorted(std::vector<Row> rows, std::string_view key,
                        std::span<Column const> columns = all_columns());

}  // namespace vibrotrough::compare
