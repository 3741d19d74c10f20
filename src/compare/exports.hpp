#pragma once

#include "compare/columns.hpp"

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace vibrotrough::compare {

/// The rows as a JSON array of objects; a value that is not known is null. Numbers are written in full.
std::string to_json(std::vector<Row> const& rows, std::span<Column const> columns = all_columns());

/// The rows as CSV with a header; a value that is not known is empty. The columns are those of the JSON.
std::string to_csv(std::vector<Row> const& rows, std::span<Column const> columns = all_columns());

/// One row with all columns, also those that the JSON for scripts does not have.
nlohmann::ordered_json to_object(Row const& row, std::span<Column const> columns = all_columns());

/// What a page needs to know to show a table of such rows: name, unit, type and meaning of each column and,
/// of the report's columns, heading, format, position and whether it is said once when it is the same in all.
nlohmann::ordered_json column_descriptions(std::span<Column const> columns = all_columns());

/// The list of the columns in Markdown, for README.md of this room.
std::string column_reference(std::span<Column const> columns = all_columns());

}  // namespace vibrotrough::compare
