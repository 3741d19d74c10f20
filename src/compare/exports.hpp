#pragma once

#include "compare/columns.hpp"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace vibrotrough::compare {

/// The rows as a JSON array of objects. A value that is not known is null. Numbers are written with all
/// digits.
std::string to_json(std::vector<Row> const& rows, std::span<Column const> columns = all_columns());

/// Receives the pieces of a long text in their order.
using TextSink = std::function<void(std::string_view piece)>;

/// Writes what to_json() returns row by row, so that the whole text is never in memory.
void write_json(std::vector<Row> const& rows, std::span<Column const> columns, TextSink const& sink);

/// The rows as CSV with a header and the columns of the JSON. A value that is not known is empty.
std::string to_csv(std::vector<Row> const& rows, std::span<Column const> columns = all_columns());

/// Writes what to_csv() returns line by line.
void write_csv(std::vector<Row> const& rows, std::span<Column const> columns, TextSink const& sink);

/// One row as a JSON object with all columns, including those that to_json() leaves out.
nlohmann::ordered_json to_object(Row const& row, std::span<Column const> columns = all_columns());

/// The members of a JSON object for the columns of Row::swept, that is, of the swept keys that have no other
/// column.
nlohmann::ordered_json swept_object(Row const& row, std::span<Column const> columns);

/// What the report needs to show a table of rows: the name, unit, type and meaning of each column and, for
/// the columns of the report, heading, format, position and whether a sentence replaces a column of equal
/// values.
nlohmann::ordered_json column_descriptions(std::span<Column const> columns = all_columns());

/// The list of the columns in Markdown, for the reference of the manual.
std::string column_reference(std::span<Column const> columns = all_columns());

}  // namespace vibrotrough::compare
