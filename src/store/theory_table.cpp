#include "store/theory_table.hpp"

#include "core/csv.hpp"
#include "core/nearest.hpp"
#include "scenario/reader/keys.hpp"
#include "store/theory_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::store {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{2} << 30;

using theory::InputColumn;

/// The column that is meant by another name: one with a unit ("stroke" is stroke_mm), or one that is spelt
/// nearly so. Empty when none is.
std::string column_meant(std::string const& name) {
    auto const all = theory::input_column_names();
    auto const found =
        std::ranges::find_if(all, [&](std::string const& one) { return one.starts_with(name + "_"); });
    if (found != all.end()) return *found;
    std::vector<std::string_view> const words(all.begin(), all.end());
    return std::string(core::nearest_word(name, words));
}

InputColumn column_named(std::string const& name, core::CsvReader const& table, std::string const& path) {
    if (auto const column = theory::input_column_named(name)) return *column;
    std::string const meant = column_meant(name);
    throw core::CsvError(path, table.header_line(), fmt::format("column '{}' is not an input", name),
                         meant.empty() ? "write names such as throw_number, tan_vibration_angle, friction"
                                       : fmt::format("did you mean {}?", meant));
}

/// Columns of one input in different units, such as frequency_hz and rpm, would overwrite each other.
void check_columns(std::vector<InputColumn> const& columns, core::CsvReader const& table,
                   std::string const& path) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
        for (std::size_t other = 0; other < c; ++other) {
            if (columns[c].input != columns[other].input) continue;
            throw core::CsvError(path, table.header_line(),
                                 fmt::format("the columns '{}' and '{}' are the same input",
                                             table.columns()[other], table.columns()[c]),
                                 "keep one of the two");
        }
    }
}

/// A column whose numbers are made from the answers.
template <typename Value>
TheoryColumn numbers(std::vector<theory::Efficiency> const& answers, char const* name,
                     char const* description, Value const& value) {
    TheoryColumn column{name, "1", description, {}, {}};
    for (theory::Efficiency const& answer : answers) column.numbers.push_back(value(answer));
    return column;
}

constexpr std::string_view converged = "converged";

/// What the theory answers for each point.
std::vector<TheoryColumn> answer_columns(std::vector<theory::Efficiency> const& answers) {
    using Point = theory::Efficiency;
    TheoryColumn mode{"mode", "1", "Phases of the motion in order", {}, {}};
    for (Point const& answer : answers) mode.texts.push_back(theory::to_string(answer.mode));
    return {
        numbers(answers, "velocity_efficiency", "Velocity efficiency eta; infinite where the mass runs away",
                [](Point const& a) { return a.velocity_efficiency; }),
        numbers(answers, "half_width", "Half-width of eta at 95 % confidence; 0 when periodic",
                [](Point const& a) { return a.half_width; }),
        mode,
        numbers(answers, "period_cycles", "Cycles after which the motion repeats; 0 when it does not",
                [](Point const& a) { return double(a.period_cycles); }),
        numbers(answers, converged.data(), "1 when the periodic motion was found, else 0",
                [](Point const& a) { return a.outcome == theory::Outcome::periodic ? 1.0 : 0.0; }),
    };
}

/// m/s, NaN where a point has no amplitude; no column when none has.
std::vector<TheoryColumn> speed_columns(TheoryPoints const& table,
                                        std::vector<theory::Efficiency> const& answers) {
    if (std::ranges::none_of(table.points, [](auto const& one) { return one.amplitude().has_value(); }))
        return {};
    TheoryColumn column{"conveying_speed", "m/s", "Conveying speed: eta omega r cos(beta)", {}, {}};
    for (std::size_t r = 0; r < answers.size(); ++r) {
        auto const scale = table.points[r].velocity_scale();
        column.numbers.push_back(scale ? answers[r].velocity_efficiency * *scale : std::nan(""));
    }
    return {column};
}

/// The columns of a survey; none without one. NaN where a point has fewer motions than others.
std::vector<TheoryColumn> motion_columns(Motions const& motions) {
    std::vector<TheoryColumn> columns;
    if (motions.empty()) return columns;
    auto const add = [&](std::string const& name, std::string const& description, auto const& value) {
        TheoryColumn column{name, "1", description, {}, {}};
        for (auto const& all : motions) column.numbers.push_back(value(all));
        columns.push_back(std::move(column));
    };
    std::size_t most = 0;
    for (auto const& all : motions) most = std::max(most, all.size());
    add("motions", "Number of motions to which different starts lead; 0 where starts cannot be followed",
        [](auto const& all) { return static_cast<double>(all.size()); });
    for (std::size_t k = 0; k < most; ++k) {
        auto const add_of_one = [&](char const* name, char const* description, auto const& value) {
            add(fmt::format("{}_{}", name, k + 1), fmt::format("{} of motion {}", description, k + 1),
                [&](auto const& all) { return k < all.size() ? value(all[k]) : std::nan(""); });
        };
        add_of_one("efficiency", "Velocity efficiency",
                   [](theory::CoexistingMotion const& m) { return m.motion.velocity_efficiency; });
        add_of_one("fraction", "Fraction of the starts",
                   [](theory::CoexistingMotion const& m) { return m.share; });
        add_of_one("period_cycles", "Period",
                   [](theory::CoexistingMotion const& m) { return double(m.motion.period_cycles); });
    }
    return columns;
}

}  // namespace

TheoryPoints read_theory_points(std::filesystem::path const& path) {
    std::error_code failure;
    std::uintmax_t const size = std::filesystem::file_size(path, failure);
    if (failure) {
        throw core::InputError(fmt::format("{}: cannot be read ({}); write the path of a CSV file",
                                           path.string(), failure.message()));
    }
    if (size > largest_file)
        throw core::InputError(fmt::format("{}: is larger than 2 GiB; split it", path.string()));
    return parse_theory_points({path, core::read_given_file(path, core::largest_file)});
}

TheoryPoints parse_theory_points(core::TextFile const& file) {
    std::string const path = file.path.string();
    core::CsvReader table(file.content, path, {.comments = true, .blanks = true});
    TheoryPoints result;
    std::vector<InputColumn> columns;
    for (std::string const& name : table.columns()) columns.push_back(column_named(name, table, path));
    check_columns(columns, table, path);
    for (InputColumn const& column : columns) result.columns.push_back(column.input);
    result.names = table.columns();
    while (table.next()) {
        theory::Inputs inputs;
        std::vector<std::string>& cells = result.cells.emplace_back();
        for (std::size_t c = 0; c < result.columns.size(); ++c) {
            if (auto const value = table.number_if_given(c))
                inputs.set(columns[c].input, *value * columns[c].factor);
            cells.push_back(core::with_decimal_point(table.cells()[c], table.separator()));
        }
        if (auto const problem = inputs.incomplete())
            table.fail(fmt::format("point {}: {}", result.cells.size(), *problem), "");
        result.points.push_back(inputs);
    }
    return result;
}

std::string theory_answers_csv(TheoryPoints const& table, std::vector<theory::Efficiency> const& answers,
                               Motions const& motions) {
    auto const known = answer_columns(answers);
    auto others = speed_columns(table, answers);
    for (TheoryColumn& column : others) column.name += "_m_per_s";
    for (TheoryColumn& column : motion_columns(motions)) others.push_back(std::move(column));
    std::string text;
    for (std::string const& name : table.names) text += name + ",";
    for (TheoryColumn const& column : known) text += (&column == known.data() ? "" : ",") + column.name;
    for (TheoryColumn const& column : others) text += "," + column.name;
    text += '\n';
    for (std::size_t r = 0; r < answers.size(); ++r) {
        for (std::string const& cell : table.cells[r]) text += core::csv_cell(cell) + ",";
        for (TheoryColumn const& column : known) {
            if (&column != known.data()) text += ',';
            text += !column.texts.empty()      ? core::csv_cell(column.texts[r])
                    : column.name == converged ? fmt::format("{}", column.numbers[r] == 1)
                                               : fmt::format("{}", column.numbers[r]);
        }
        for (TheoryColumn const& column : others)
            text += std::isnan(column.numbers[r]) ? "," : fmt::format(",{}", column.numbers[r]);
        text += '\n';
    }
    return text;
}

void write_theory_answers(std::filesystem::path const& path, TheoryPoints const& table,
                          std::vector<theory::Efficiency> const& answers, Motions const& motions) {
    std::vector<TheoryColumn> columns;
    for (theory::Input const input : table.columns) {
        TheoryColumn column{std::string(theory::name_of(input)), units_of(input), "Input", {}, {}};
        for (theory::Inputs const& point : table.points)
            column.numbers.push_back(point.get(input).value_or(std::nan("")));
        columns.push_back(std::move(column));
    }
    for (auto& part : {answer_columns(answers), speed_columns(table, answers), motion_columns(motions)})
        columns.insert(columns.end(), part.begin(), part.end());
    write_theory_table(path, columns);
}

}  // namespace vibrotrough::store
