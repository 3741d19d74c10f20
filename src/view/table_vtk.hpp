#pragma once

#include "compare/columns.hpp"

#include <filesystem>
#include <span>
#include <vector>

namespace vibrotrough::view {

/// Writes the columns of `compare` that scripts see as a table for ParaView (.vtt), inline binary,
/// atomically: numbers as doubles, NaN where they are not known, and texts, empty where they are not known.
/// @throws MissingError when the disk refuses
void write_table(std::filesystem::path const& path, std::vector<compare::Row> const& rows,
                 std::span<compare::Column const> columns = compare::all_columns());

}  // namespace vibrotrough::view
