#include "compare/stage_rows.hpp"

#include "core/error.hpp"
#include "core/text.hpp"
#include "store/result_file.hpp"
#include "store/schema.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

/// The members of Row::own before those of the table `stages`.
enum FirstValues { stage_number, speed_theory, speed_rolling_layer, first_of_table };

std::optional<double> number_of(Row const& row, std::string_view name) {
    auto const& entries = store::case_table("stages").columns;
    auto const place = std::ranges::find(entries, name, &store::Entry::name) - entries.begin();
    auto const value = row.own.at(first_of_table + static_cast<std::size_t>(place));
    return value ? std::optional(std::get<double>(*value)) : std::nullopt;
}

/// A number with its half-width.
std::string cell(Row const& row, std::string const& name, int digits) {
    auto const value = number_of(row, name), width = number_of(row, name + "_half_width");
    if (!value) return "-";
    std::string const mean = core::without_sign_of_zero(fmt::format("{:.{}f}", *value, digits));
    return width ? fmt::format("{} +- {:.{}f}", mean, *width, digits) : mean;
}

/// How the terminal shows a number of the table `stages`.
struct Shown {
    std::string_view name, heading, subheading;
    int priority;
    std::string_view format;
    std::string (*cell)(Row const&) = nullptr;
    bool only_when_known = false;
};

constexpr std::array shown{
    Shown{"start", "start", "s", 3, "{:.2f}"},
    Shown{"time", "time", "s", 5, "{:.2f}"},
    Shown{"ramp_cycles", "ramp", "cycles", 2, "{:.0f}"},
    Shown{"throw_number", "Gamma", "", 8, "{:.3f}"},
    Shown{"frequency", "f", "Hz", 4, "{:.2f}"},
    Shown{"amplitude", "r", "m", 4, "{:.4f}"},
    Shown{"conveying_speed", "speed", "m/s", 9, "{:.4f}",
          [](Row const& row) { return cell(row, "conveying_speed", 4); }},
    Shown{"distance", "distance", "m", 6, "{:.4f}", [](Row const& row) { return cell(row, "distance", 4); }},
    Shown{"time_to_speed", "to speed", "s", 6, "{:.3f}",
          [](Row const& row) { return cell(row, "time_to_speed", 3); }},
    Shown{"fed_mass", "fed", "kg", 4, "{:.4f}", [](Row const& row) { return cell(row, "fed_mass", 4); },
          true},
    Shown{"left_mass", "out", "kg", 7, "{:.4f}", [](Row const& row) { return cell(row, "left_mass", 4); },
          true},
    Shown{"held_mass", "held", "kg", 5, "{:.4f}", [](Row const& row) { return cell(row, "held_mass", 4); },
          true},
};

/// A column of Row::own.
Column column_of(int place, std::string_view name, std::string_view unit, std::string_view meaning) {
    return {.name = std::string(name) + unit_suffix(unit),
            .unit = std::string(unit),
            .value = +[](Row const&) -> std::optional<double> { return {}; },
            .meaning = std::string(meaning),
            .format = "{:.4f}",
            .own = place};
}

/// The columns of the theory, behind that of the speed.
std::vector<Column> columns_of_theory() {
    Column point =
        column_of(speed_theory, "speed_theory", "m/s",
                  "Speed of the plastic point mass at the friction of a grain on the trough, driven "
                  "as in this stage for good; unknown at a standstill");
    point.terminal = TerminalView{.heading = "theory", .subheading = "m/s", .priority = 8};
    Column rolling =
        column_of(speed_rolling_layer, "speed_rolling_layer", "m/s",
                  "Speed by the rolling-layer law for the drive of this stage; unknown outside the "
                  "range where the law has been tested");
    rolling.terminal =
        TerminalView{.heading = "rolling law", .subheading = "m/s", .priority = 3, .only_when_known = true};
    return {point, rolling};
}

}  // namespace

std::vector<Row> stage_rows(std::string const& id, prepare::PreparedCase const& prepared,
                            store::CaseRecord const& record, std::string const& outcome) {
    std::vector<Row> rows;
    store::CaseTable const& stages = store::case_table("stages");
    auto const table = stages.values(record);
    for (std::size_t i = 0; i < prepared.stages.size(); ++i) {
        scenario::Stage const& stage = prepared.stages[i];
        // A case with stages has no theory, but its stages do.
        prepare::PreparedCase const& alone = stage.standstill ? prepared : of_stage(prepared, stage);
        Row row = compare(id, alone, {}, outcome);
        auto const speed = [&](std::optional<double> const& efficiency) {
            return efficiency ? value_of(*efficiency * alone.velocity_scale) : std::nullopt;
        };
        row.own.resize(first_of_table + stages.columns.size());
        row.own[speed_theory] = speed(row.efficiency_theory);
        row.own[speed_rolling_layer] = speed(row.efficiency_rolling_layer);
        row.own[stage_number] = static_cast<int>(i) + 1;
        for (std::size_t column = 0; column < table.size(); ++column)
            row.own[first_of_table + column] = value_of(std::get<std::vector<double>>(table[column])[i]);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<Row> stage_rows(ComparedCases const& compared) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < compared.cases.size(); ++i) {
        campaign::PlannedCase const& planned = *compared.cases[i].planned;
        store::CaseRecord record{};
        if (compared.cases[i].result) record = store::read_result(planned.result_file());
        record.scenario = planned.scenario();
        for (Row& row : stage_rows(planned.id, *planned.prepared, record, compared.rows[i].outcome)) {
            row.swept = compared.rows[i].swept;
            rows.push_back(std::move(row));
        }
    }
    if (rows.empty())
        throw core::InputError(
            "--stages: no case of this campaign has [[stages]]; 'vibrotrough init stages' writes an example");
    return rows;
}

std::vector<Column> stage_columns(std::span<Column const> columns) {
    std::vector<Column> chosen;
    for (Column const& column : columns)
        if (column.name == "case" || column.swept >= 0) chosen.push_back(column);
    Column number = column_of(stage_number, "stage", "1", "Number of the stage, from 1");
    number.value = +[](Row const&) -> std::optional<int> { return {}; };
    number.format = "{}";
    number.terminal = TerminalView{.heading = "stage", .priority = always_shown};
    chosen.push_back(std::move(number));
    int place = first_of_table;
    for (store::Entry const& entry : store::case_table("stages").columns) {
        Column column = column_of(place++, entry.name, entry.units, entry.meaning);
        if (auto const view = std::ranges::find(shown, entry.name, &Shown::name); view != shown.end()) {
            column.terminal = TerminalView{.heading = view->heading,
                                           .subheading = view->subheading,
                                           .priority = view->priority,
                                           .only_when_known = view->only_when_known};
            column.format = view->format;
            column.cell = view->cell;
        }
        bool const is_speed = entry.name == "conveying_speed";
        chosen.push_back(std::move(column));
        if (!is_speed) continue;
        for (Column& theory : columns_of_theory()) chosen.push_back(std::move(theory));
    }
    for (std::string_view const name : {"mode_theory", "outcome"})
        chosen.push_back(*std::ranges::find(columns, name, &Column::name));
    return chosen;
}

}  // namespace vibrotrough::compare
