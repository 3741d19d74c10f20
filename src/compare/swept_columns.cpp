#include "compare/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrotrough::compare {
namespace {

using scenario::Key;
using scenario::KeyKind;

constexpr int swept_priority = 8;

/// The heading in the terminal of columns that are shown there only when their key is swept.
struct Heading {
    std::string_view name, heading, subheading;
};
constexpr std::array headings{Heading{"machine_number", "K", ""}, Heading{"amplitude_m", "r", "mm"},
                              Heading{"stroke_mm", "stroke", "mm"}};

/// A function that stands for the type of a column of Row::swept.
template <typename Type>
constexpr auto nothing = +[](Row const&) -> std::optional<Type> { return {}; };

Column::Function type_of(Key const& key) {
    if (has_words(key)) return nothing<std::string>;
    if (key.kind == KeyKind::integer) return nothing<int>;
    return nothing<double>;
}

std::string_view unit_of(Key const& key) {
    if (key.unit.empty()) return "1";
    return key.unit == "radian" ? "degree" : key.unit;
}

/// What stands below the name of a key: its unit or, without one, to what it belongs.
std::string_view subheading_of(Key const& key) {
    if (!key.unit.empty()) return scenario::shown_unit(key).name;
    if (key.path.starts_with("grains.")) return "of grains";
    return key.path.starts_with("layer.") ? "of layer" : "";
}

Column column_of(Key const& key, int place) {
    scenario::ShownUnit const shown = scenario::shown_unit(key);
    bool const is_angle = key.unit == "radian";  // Row::swept holds degrees
    return {.name = std::string(key.path),
            .unit = std::string(unit_of(key)),
            .value = type_of(key),
            .meaning = std::string(key.meaning),
            .format = has_words(key) || key.kind == KeyKind::integer ? "{}" : "{:.6g}",
            .terminal = TerminalView{.heading = key.path.substr(key.path.find('.') + 1),
                                     .subheading = subheading_of(key),
                                     .priority = swept_priority},
            .report = ReportView{.heading = scenario::short_name(key)},
            .key = key.path,
            .swept = place,
            .factor = is_angle ? 1 : shown.factor,
            .shown_unit = is_angle || shown.factor == 1 ? "" : shown.name};
}

/// Shows a column that is always there as one of a swept key.
void promote(Column& column, Key const& key) {
    if (!column.terminal) {
        auto const found = std::ranges::find(headings, column.name, &Heading::name);
        column.terminal = TerminalView{.heading = key.path.substr(key.path.find('.') + 1)};
        if (found != headings.end())
            column.terminal = TerminalView{.heading = found->heading, .subheading = found->subheading};
    }
    column.terminal->priority = swept_priority;
    if (!column.report) column.report = ReportView{.heading = scenario::short_name(key)};
}

/// A sweep of the restitution is compared with both theories in the terminal, too.
void show_both_theories(std::vector<Column>& columns) {
    std::ranges::find(columns, "efficiency_theory", &Column::name)->terminal->subheading = "plastic";
    std::ranges::find(columns, "efficiency_theory_restitution", &Column::name)->terminal =
        TerminalView{.heading = "eta theory", .subheading = "restitution", .priority = 7};
}

}  // namespace

std::vector<Column> columns_with_swept(scenario::SweptKeys const& swept) {
    std::vector<Column> columns(all_columns().begin(), all_columns().end());
    for (std::size_t i = 0; i < swept.size(); ++i) {
        auto const known = std::ranges::find(columns, swept[i]->path, &Column::key);
        Column column = known == columns.end() ? column_of(*swept[i], static_cast<int>(i)) : *known;
        if (known != columns.end()) {
            promote(column, *swept[i]);
            columns.erase(known);
        }
        columns.insert(columns.begin() + 1 + static_cast<std::ptrdiff_t>(i), std::move(column));
    }
    if (sweeps_restitution(swept)) show_both_theories(columns);
    return columns;
}

bool sweeps_restitution(scenario::SweptKeys const& swept) {
    return std::ranges::any_of(swept, [](Key const* key) {
        return key->path == "trough.restitution" || key->path.ends_with(".trough_restitution");
    });
}

bool is_swept(Column const& column, scenario::SweptKeys const& swept) {
    return std::ranges::any_of(swept, [&](Key const* key) { return key->path == column.key; });
}

std::optional<Value> swept_value(scenario::Scenario const& scenario, Key const& key) {
    auto const value = key.get(scenario);
    if (!value) return {};
    if (auto const word = scenario::word_of(scenario, key.path)) return *word;
    auto const* const number = std::get_if<double>(&*value);
    if (number == nullptr) return {};
    if (key.kind == KeyKind::integer) return static_cast<int>(std::lround(*number));
    return key.unit == "radian" ? scenario::in_degrees(*number) : *number;
}

}  // namespace vibrotrough::compare
