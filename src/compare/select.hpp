#pragma once

#include "compare/columns.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace vibrotrough::compare {

/// A column by its name of today or before, with or without its unit, or by its key in the campaign file, in
/// full or, for swept keys, without its section where that is unique.
/// @param option  names what asks, in the error
/// @throws core::InputError when there is no such column; it names the nearest
Column const& column_named(std::span<Column const> columns, std::string_view option, std::string_view name);

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
