#pragma once

#include "compare/comparison.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::compare {

/// Whether a column of the JSON holds texts; all others hold numbers.
bool is_text_column(std::string_view column);

/// Keeps the rows that fulfil a condition such as "throw_number>1.5" or "outcome=finished": a column of the
/// JSON or `difference` (efficiency_dem - efficiency_theory), one of > >= < <= = == !=, and a value. Columns
/// of text know only = and !=. A number that is not known fulfils no condition.
/// @throws InputError when there is no such column or operator, or the value is none for this column
std::vector<Row> filtered(std::vector<Row> const& rows, std::string_view condition);

/// Sorts by "COLUMN", "COLUMN:asc" or "COLUMN:desc"; rows that are equal keep their order, and rows whose
/// number is not known come last. @throws InputError when there is no such column or order
std::vector<Row> sorted(std::vector<Row> rows, std::string_view key);

}  // namespace vibrotrough::compare
