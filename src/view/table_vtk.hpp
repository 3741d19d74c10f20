#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace vibrotrough::view {

/// One column of a table.
struct TableColumn {
    std::string name;                                                    ///< heading
    std::variant<std::vector<double>, std::vector<std::string>> values;  ///< one for each row; NaN: not known
};

/// Writes a table for ParaView (.vtt), inline binary, atomically. All columns have the same length.
/// @throws MissingError when the disk refuses
void write_table(std::filesystem::path const& path, std::vector<TableColumn> const& columns);

}  // namespace vibrotrough::view
