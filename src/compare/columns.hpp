#pragma once

#include "compare/comparison.hpp"
#include "scenario/reader/swept_keys.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// @file
/// The table of all columns of `compare`. JSON, CSV, the terminal's table, --filter, --sort, the VTK table,
/// the report and the list in README.md all follow from it.

namespace vibrotrough::compare {

/// The type of a column's values, in the order of the variant Value.
enum class ColumnType {
    number,   ///< floating point
    integer,  ///< whole number
    text,     ///< UTF-8
};

/// How the terminal's table shows a column.
struct TerminalView {
    std::string_view heading;          ///< first line above the column
    std::string_view subheading = "";  ///< the line below it: the unit, or a remark
    int priority = 1;  ///< the column with the smallest is left out first when the terminal is too narrow
    bool flush_left = false;                      ///< aligned to the left, for texts of different length
    bool only_when_known = false;                 ///< left out when no case has a value
    std::string (*cell)(Row const&) = nullptr;    ///< what is shown in place of the formatted value
    std::string (*colour)(Row const&) = nullptr;  ///< ANSI escape; empty: none
};

/// Columns of this priority are never left out of the terminal's table.
constexpr int always_shown = 9;

/// How the report's table shows a column.
struct ReportView {
    std::string_view heading;  ///< above the column
    bool once_when_same =
        false;  ///< when all cases have the same value, one sentence gives it instead of a column
};

/// One column: its name, its value and how each view shows it.
struct Column {
    std::string_view name;  ///< for scripts, which rely on it
    std::string_view unit;  ///< in the spelling of udunits2; "1" for pure numbers and for texts
    /// A function that gives the value of a row, none where it is not known. Its type is the column's type.
    using Function = std::variant<std::optional<double> (*)(Row const&), std::optional<int> (*)(Row const&),
                                  std::optional<std::string> (*)(Row const&)>;
    Function value;            ///< gives the value of a row; of a column of Row::swept only the type counts
    std::string_view meaning;  ///< one sentence for people, in the README and the report
    std::string_view format =
        "{}";             ///< of a value in tables for people, as both fmt and Python understand it
    int position = 0;     ///< in tables for people, counted from the left
    bool in_data = true;  ///< whether JSON, CSV and the VTK table have it
    std::optional<TerminalView> terminal = {};  ///< none: not in the terminal's table
    std::optional<ReportView> report = {};      ///< none: not in the report's table
    std::string_view key = "";  ///< of the campaign file, another name for --filter and --sort; may be empty
    int swept = -1;             ///< place in Row::swept; negative for other columns
    double factor = 1;          ///< tables for people show the number times this, in the unit `shown_unit`
    std::string_view shown_unit = "";  ///< empty: `unit`

    /// The type of the values.
    ColumnType type() const { return static_cast<ColumnType>(value.index()); }
    /// The value of a row; none when it is not known.
    std::optional<Value> of(Row const& row) const;
    /// The value as tables for people show it; "-" when it is not known.
    std::string shown(Row const& row) const;
};

/// All columns, in the order of JSON and CSV.
std::span<Column const> all_columns();

/// All columns and one for each swept key that has none, named like the key. The columns of swept keys come
/// right behind the case in tables for people, and are left out last.
std::vector<Column> columns_with_swept(scenario::SweptKeys const& swept);

/// Whether a column shows one of these keys.
bool is_swept(Column const& column, scenario::SweptKeys const& swept);

/// The value of a swept key for its column: as scenario::key_value, but angles in degrees.
std::optional<Value> swept_value(scenario::Scenario const& scenario, scenario::Key const& key);

/// The same columns for the terminal's table of `compare --budget`: efficiency_dem with its statistical and
/// its numerical error, a star behind one that is borrowed and < before a bound, and which of the two is
/// larger.
std::vector<Column> budget_columns(std::span<Column const> columns = all_columns());

}  // namespace vibrotrough::compare
