#pragma once

#include "compare/comparison.hpp"
#include "scenario/reader/swept_keys.hpp"
#include "store/observable.hpp"
#include "store/quantity.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// @file
/// The table of all columns of `compare`. JSON, CSV, the terminal's table, --filter, --sort, the VTK table,
/// the report and the reference that `vibrotrough quantities` prints follow from it. The columns of what was
/// measured follow from the quantities of store/quantity.hpp.

namespace vibrotrough::compare {

/// The type of a column's values, in the order of the variant Value.
enum class ColumnType {
    number,   ///< floating point
    integer,  ///< whole number
    text,     ///< UTF-8
};

using store::always_shown;
using store::ReportView;
using store::TerminalView;

/// One column: its name, its value and how each view shows it.
struct Column {
    std::string name;  ///< for scripts, which rely on it
    std::string unit;  ///< in the spelling of udunits2; "1" for pure numbers and for texts
    /// A function that gives the value of a row, none where it is not known. Its type is the column's type.
    using Function = std::variant<std::optional<double> (*)(Row const&), std::optional<int> (*)(Row const&),
                                  std::optional<std::string> (*)(Row const&)>;
    Function value;  ///< gives the value of a row; of Row::swept, measured, own and observed only the type
                     ///< counts
    std::string meaning;  ///< one sentence for people, in the reference and the report
    std::string_view format =
        "{}";             ///< of a value in tables for people, as both fmt and Python understand it
    bool in_data = true;  ///< whether JSON, CSV and the VTK table have it
    std::optional<TerminalView> terminal = {};    ///< none: not in the terminal's table
    std::optional<ReportView> report = {};        ///< none: not in the report's table
    std::string (*cell)(Row const&) = nullptr;    ///< what the terminal shows in place of the formatted value
    std::string (*colour)(Row const&) = nullptr;  ///< ANSI escape for the terminal; empty: none
    std::string_view key = "";  ///< of the campaign file, another name for --filter and --sort; may be empty
    int swept = -1;             ///< place in Row::swept; negative for other columns
    int measured = -1;          ///< place in Row::measured; negative for other columns
    int own = -1;               ///< place in Row::own; negative for other columns
    int observed = -1;          ///< place in Row::observed; negative for other columns
    double unit_factor = 1;     ///< of the values in `unit` against those in Row::measured
    double factor = 1;          ///< tables for people show the number times this, in the unit `shown_unit`
    std::string_view shown_unit = "";               ///< empty: `unit`
    std::shared_ptr<std::string const> words = {};  ///< keeps headings that are not part of the program

    /// The type of the values.
    ColumnType type() const { return static_cast<ColumnType>(value.index()); }
    /// The value of a row; none when it is not known.
    std::optional<Value> of(Row const& row) const;
    /// The value as tables for people show it; "-" when it is not known.
    std::string shown(Row const& row) const;
};

/// All columns, in the order of every table.
std::span<Column const> all_columns();

/// All columns and one for each swept key that has none, named like the key. The columns of swept keys come
/// right behind the case, and are left out last in the terminal.
std::vector<Column> columns_with_swept(scenario::SweptKeys const& swept);

/// Whether the restitution of grains on the trough is swept. The theory with restitution then has a column in
/// the terminal, too.
bool sweeps_restitution(scenario::SweptKeys const& swept);

/// Adds the columns of a person's own quantities before the outcome, for each number one of its mean and one
/// of its half-width. Those that the program has meanwhile a quantity of the same name for are left out.
void add_observed(std::vector<Column>& columns, std::span<store::Observable const> observables);

/// Whether a column or a quantity of the program has this name, or had it once.
bool is_name_of_program(std::string_view name, std::string const& unit);

/// What the names of columns in text files end in, because these files tell no units: t/h/m is _t_per_h_m.
std::string unit_suffix(std::string_view unit);

/// Whether a column shows one of these keys.
bool is_swept(Column const& column, scenario::SweptKeys const& swept);

/// The value of a swept key for its column: as scenario::key_value, but angles in degrees.
std::optional<Value> swept_value(scenario::Scenario const& scenario, scenario::Key const& key);

/// The same columns for the terminal's table of `compare --budget`: the efficiency with its statistical and
/// its numerical error, a star behind one that is only expected, and which of the two is larger.
std::vector<Column> budget_columns(std::span<Column const> columns = all_columns());

}  // namespace vibrotrough::compare
