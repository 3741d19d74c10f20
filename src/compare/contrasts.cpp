#include "compare/contrasts.hpp"

#include "core/error.hpp"
#include "core/text.hpp"
#include "measure/difference.hpp"
#include "prepare/numerical_errors.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::compare {
namespace {

/// The members of Row::own.
enum ContrastValues {
    base_case,
    eta_difference,
    eta_half_width,
    eta_statistics,
    eta_numerics,
    is_significant,
    count_of_values
};

std::optional<double> number_at(Row const& row, ContrastValues place) {
    auto const& value = row.own.at(place);
    return value ? std::optional(std::get<double>(*value)) : std::nullopt;
}

/// Whether two cases differ in nothing but what the materials of grains and trough are. Young's modulus is
/// numerics and is judged on its own.
bool differ_in_materials_only(scenario::Scenario one, scenario::Scenario const& other) {
    one.trough.friction = other.trough.friction;
    one.trough.restitution = other.trough.restitution;
    one.grains.friction = other.grains.friction;
    one.grains.restitution = other.grains.restitution;
    one.grains.rotation = other.grains.rotation;
    one.grains.rolling_friction = other.grains.rolling_friction;
    one.grains.youngs_modulus = other.grains.youngs_modulus;
    return identity_of(one) == identity_of(other);
}

/// The row of a case with its difference from another one.
Row contrast_row(ComparedCases const& compared, std::size_t one, std::size_t other) {
    Row row = compared.rows[one];
    Row const& base = compared.rows[other];
    row.own.assign(count_of_values, {});
    row.own[base_case] = base.id;
    auto const efficiency = row.number("efficiency"), efficiency_of_base = base.number("efficiency");
    if (!efficiency || !efficiency_of_base) return row;
    row.own[eta_difference] = *efficiency - *efficiency_of_base;
    scenario::Scenario const& scenario = compared.cases[one].planned->scenario();
    scenario::Scenario const& scenario_of_base = compared.cases[other].planned->scenario();
    auto const statistics = half_width_of_difference(*compared.estimates[one], *compared.estimates[other],
                                                     scenario.measure.confidence);
    auto const error = numerics_of_difference(scenario, row, scenario_of_base, base);
    row.own[eta_statistics] = value_of(statistics);
    row.own[eta_numerics] = value_of(error);
    if (!statistics) return row;
    double const whole = std::hypot(*statistics, error.value_or(0));
    row.own[eta_half_width] = whole;
    row.own[is_significant] = std::abs(*efficiency - *efficiency_of_base) > whole ? "yes" : "no";
    return row;
}

std::string difference_cell(Row const& row) {
    auto const value = number_at(row, eta_difference), width = number_at(row, eta_half_width);
    if (!value) return "-";
    return fmt::format("{:+.3f}", *value) + (width ? " +- " + core::three_digits(width) : "");
}

Column column_of(ContrastValues place, std::string_view name, std::string_view meaning) {
    return {.name = std::string(name),
            .unit = "1",
            .value = +[](Row const&) -> std::optional<double> { return {}; },
            .meaning = std::string(meaning),
            .format = "{:.3f}",
            .own = place};
}

Column text_column_of(ContrastValues place, std::string_view name, std::string_view meaning) {
    Column column = column_of(place, name, meaning);
    column.value = +[](Row const&) -> std::optional<std::string> { return {}; };
    column.format = "{}";
    return column;
}

/// Of the difference and its parts.
std::vector<Column> columns_of_difference() {
    Column base = text_column_of(base_case, "against", "Case whose velocity efficiency is taken off");
    base.terminal = TerminalView{.heading = "against", .priority = always_shown, .flush_left = true};
    Column value = column_of(eta_difference, "efficiency_difference",
                             "Velocity efficiency of the case less that of the other one");
    value.terminal = TerminalView{.heading = "difference", .priority = always_shown};
    value.cell = difference_cell;
    value.format = "{:+.3f}";
    Column is_known = text_column_of(is_significant, "significant",
                                     "yes where the difference is larger than its half-width, else no");
    is_known.terminal = TerminalView{.heading = "significant", .priority = always_shown};
    return {
        base,
        value,
        column_of(eta_half_width, "efficiency_difference_half_width",
                  "Half-width of its interval at measure.confidence, for statistics and numerics together"),
        column_of(
            eta_statistics, "efficiency_difference_half_width_statistics",
            "The part of the packings' scatter, Welch's interval with Student's t over the packings of both, "
            "and of what is left of their start-ups (efficiency_drift)"),
        column_of(eta_numerics, "efficiency_difference_numerics",
                  "The part of the numerical errors that do not cancel"),
        is_known};
}

std::size_t place_of(campaign::Plan const& plan, std::string_view key) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < plan.swept.size(); ++i) {
        std::string_view const path = plan.swept[i]->path;
        if (path == key) return i;
        if (path.substr(path.find('.') + 1) == key) found.push_back(i);
    }
    if (found.size() == 1) return found.front();
    std::vector<std::string_view> paths;
    for (scenario::Key const* const one : plan.swept) paths.push_back(one->path);
    throw core::InputError(fmt::format(
        "--contrast: this campaign does not sweep '{}', so that no cases differ in it alone; {}", key,
        paths.empty() ? "it sweeps nothing" : fmt::format("it sweeps {}", fmt::join(paths, ", "))));
}

}  // namespace

std::optional<double> numerics_of_difference(scenario::Scenario const& one, Row const& row_of_one,
                                             scenario::Scenario const& other, Row const& row_of_other) {
    auto const of_one = row_of_one.number("efficiency_numerics"),
               of_other = row_of_other.number("efficiency_numerics");
    if (!of_one && !of_other) return {};
    bool const is_alike = differ_in_materials_only(one, other);
    if (is_alike && one.grains.youngs_modulus == other.grains.youngs_modulus) return 0;
    if (!is_alike || !is_expected(row_of_one) || !is_expected(row_of_other))
        return std::hypot(of_one.value_or(0), of_other.value_or(0));
    return std::hypot(prepare::numerical_errors(one).softness, prepare::numerical_errors(other).softness);
}

std::vector<Row> contrast_rows_against(ComparedCases const& compared, std::string_view case_id) {
    auto const base = std::ranges::find(compared.rows, case_id, &Row::id);
    if (base == compared.rows.end())
        throw core::InputError(fmt::format(
            "--against: this campaign has no case '{}'; 'vibrotrough compare' lists them in its first column",
            case_id));
    auto const other = static_cast<std::size_t>(base - compared.rows.begin());
    std::vector<Row> rows;
    for (std::size_t i = 0; i < compared.rows.size(); ++i)
        if (i != other) rows.push_back(contrast_row(compared, i, other));
    return rows;
}

std::vector<Row> contrast_rows_of(campaign::Plan const& plan, ComparedCases const& compared,
                                  std::string_view key) {
    std::size_t const place = place_of(plan, key);
    std::map<std::vector<std::optional<Value>>, std::size_t> first;  // by the values of the other keys
    std::vector<Row> rows;
    for (std::size_t i = 0; i < compared.rows.size(); ++i) {
        auto others = compared.rows[i].swept;
        others.at(place).reset();
        auto const [base, is_new] = first.emplace(std::move(others), i);
        if (!is_new) rows.push_back(contrast_row(compared, i, base->second));
    }
    return rows;
}

std::vector<Column> contrast_columns(std::span<Column const> columns, scenario::SweptKeys const& swept) {
    std::vector<Column> chosen;
    for (Column const& column : columns)
        if (column.name == "case" || column.name == "efficiency" || is_swept(column, swept))
            chosen.push_back(column);
    for (Column& column : columns_of_difference()) chosen.push_back(std::move(column));
    return chosen;
}

}  // namespace vibrotrough::compare
