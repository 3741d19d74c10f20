#pragma once

#include "compare/comparison.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

/// The one table of what can be said of a case. JSON, CSV, the terminal's table, --filter, --sort, the VTK
/// table, the report and the list in README.md all follow from it.
namespace vibrotrough::compare {

/// A value of a column that is known.
using Value = std::variant<double, int, std::string>;

enum class ColumnType { number, integer, text };

/// How the terminal's table shows a column.
struct TerminalView {
    std::string_view heading;
    std::string_view subheading = "";  ///< the line below it: the unit, or a remark
    int priority = 1;                  ///< the smallest is left out first when the terminal is too narrow
    bool flush_left = false;           ///< for texts of different length
    bool only_when_known = false;      ///< left out when it is known of no case
    std::string (*cell)(Row const&) = nullptr;    ///< what is shown in place of the formatted value
    std::string (*colour)(Row const&) = nullptr;  ///< ANSI escape; empty: none
};

/// Columns of this priority are never left out of the terminal's table.
constexpr int always_shown = 9;

/// How the report's table shows a column.
struct ReportView {
    std::string_view heading;
    bool once_when_same = false;  ///< said in one sentence instead when all cases have the same value
};

struct Column {
    std::string_view name;  ///< for scripts; a contract with them
    std::string_view unit;  ///< in the spelling of udunits2; "1" for pure numbers and for texts
    /// The value of a row, none where it is not known. Its kind is the column's type.
    std::variant<std::optional<double> (*)(Row const&), std::optional<int> (*)(Row const&),
                 std::optional<std::string> (*)(Row const&)>
        value;
    std::string_view meaning;
    std::string_view format =
        "{}";             ///< of a value in tables for people, as both fmt and Python understand it
    int position = 0;     ///< in tables for people, counted from the left
    bool in_data = true;  ///< whether JSON, CSV and the VTK table have it
    std::optional<TerminalView> terminal = {};  ///< none: not in the terminal's table
    std::optional<ReportView> report = {};      ///< none: not in the report's table

    ColumnType type() const { return static_cast<ColumnType>(value.index()); }
    std::optional<Value> of(Row const& row) const;
    /// The value as tables for people show it; "-" when it is not known.
    std::string shown(Row const& row) const;
};

/// All columns, in the order of JSON and CSV.
std::span<Column const> all_columns();

}  // namespace vibrotrough::compare
