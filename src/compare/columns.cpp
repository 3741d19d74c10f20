#include "compare/columns.hpp"

#include "compare/drive_columns.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

std::optional<double> difference(Row const& row) {
    auto const efficiency = row.number("efficiency");
    if (!efficiency || !row.efficiency_theory) return {};
    return *efficiency - *row.efficiency_theory;
}

std::string efficiency_cell(Row const& row) {
    auto const efficiency = row.number("efficiency"), width = row.number("efficiency_half_width");
    return core::three_digits(efficiency) + (efficiency && width ? " +- " + core::three_digits(width) : "");
}

std::string atlas_cell(Row const& row) {
    auto const width = row.efficiency_atlas_half_width;
    return core::three_digits(row.efficiency_atlas) + (width ? " +- " + core::three_digits(width) : "");
}

std::string restitution_cell(Row const& row) {
    auto const width = row.efficiency_theory_restitution_half_width;
    return core::three_digits(row.efficiency_theory_restitution) +
           (width ? " +- " + core::three_digits(width) : "");
}

/// A mass flow in t/h with its half-width.
std::string flow_cell(Row const& row, std::string const& quantity) {
    auto const flow = row.number(quantity), width = row.number(quantity + "_half_width");
    if (!flow) return "-";
    std::string const mean = fmt::format("{:.3g}", store::tonnes_per_hour * *flow);
    return width ? fmt::format("{} +- {:.2g}", mean, store::tonnes_per_hour * *width) : mean;
}

std::string cycles_cell(Row const& row) {
    auto const measured = row.number("cycles_measured"), discarded = row.number("cycles_discarded");
    return measured && discarded ? fmt::format("{}+{}", *discarded, *measured) : "-";
}

/// Sets what the terminal shows of several quantities in one cell.
void set_cells(std::vector<Column>& columns) {
    auto const set = [&](std::string_view name, std::string (*cell)(Row const&)) {
        auto const found = std::ranges::find(columns, name, &Column::name);
        if (found == columns.end()) throw std::logic_error("no column " + std::string(name));
        found->cell = cell;
    };
    set("efficiency", efficiency_cell);
    set("cycles_measured", cycles_cell);
    set("mass_flow_t_per_h", [](Row const& row) { return flow_cell(row, "mass_flow"); });
    set("mass_flow_per_width_t_per_h_m",
        [](Row const& row) { return flow_cell(row, "mass_flow_per_width"); });
}

/// Colours that the colour-blind tell apart: yellow where the layer is faster than the theory, cyan where it
/// is slower, bold from 0.1 on; none within the confidence interval.
std::string difference_colour(Row const& row) {
    auto const value = difference(row);
    if (!value || std::abs(*value) <= row.number("efficiency_half_width").value_or(0.0)) return {};
    return fmt::format("\x1b[{}{}m", std::abs(*value) >= 0.1 ? "1;" : "", *value > 0 ? 33 : 36);
}

std::string outcome_colour(Row const& row) {
    auto const outcome = core::outcome_named(row.outcome);  // none while the case has not ended
    bool const is_fine =
        !outcome || *outcome == core::Outcome::finished || *outcome == core::Outcome::interrupted;
    return is_fine ? "" : "\x1b[31m";
}

std::vector<Column> theory_columns() {
    return {
        {.name = "larger_error",
         .unit = "1",
         .value = larger_error,
         .meaning = "Which error of efficiency is larger: statistical (efficiency_half_width_statistics) or "
                    "numerical",
         .report = ReportView{.heading = "larger error"}},
        {.name = "efficiency_theory",
         .unit = "1",
         .value = field<&Row::efficiency_theory>,
         .meaning =
             "Velocity efficiency of the plastic point mass of the paper, whatever the restitution, at "
             "the friction of a grain on the trough; unknown when it has no mean speed",
         .format = "{:.3f}",
         .terminal = TerminalView{.heading = "eta theory", .subheading = "at mu", .priority = 7},
         .report = ReportView{.heading = "\u03b7, theory (plastic)"}},
        {.name = "efficiency_theory_restitution",
         .unit = "1",
         .value = field<&Row::efficiency_theory_restitution>,
         .meaning = "Velocity efficiency of the same point mass with the restitution of a grain on the "
                    "trough in place of a plastic landing; unknown without a mean speed and for a "
                    "restitution above 0.95, which the theory refuses",
         .format = "{:.3f}",
         .report = ReportView{.heading = "\u03b7, theory (restitution)"},
         .cell = restitution_cell},
        {.name = "efficiency_theory_restitution_half_width",
         .unit = "1",
         .value = field<&Row::efficiency_theory_restitution_half_width>,
         .meaning = "Half-width of the 95 % interval of efficiency_theory_restitution where that motion has "
                    "no period; unknown where it is exact"},
    };
}

/// What is known of layers.
std::vector<Column> model_columns() {
    return {
        {.name = "efficiency_rolling_layer",
         .unit = "1",
         .value = field<&Row::efficiency_rolling_layer>,
         .meaning =
             "Velocity efficiency of the rolling-layer law with its published constants, for spheres "
             "that may rotate; unknown outside the throw numbers, slopes, frictions and depths at which "
             "the law has been tested",
         .format = "{:.3f}",
         .terminal =
             TerminalView{
                 .heading = "eta rolling", .subheading = "layer law", .priority = 2, .only_when_known = true},
         .report = ReportView{.heading = "\u03b7, rolling layer"}},
        {.name = "efficiency_atlas",
         .unit = "1",
         .value = field<&Row::efficiency_atlas>,
         .meaning = "Velocity efficiency from the atlas, a surface over simulated layers of spheres; unknown "
                    "for layers outside of it",
         .format = "{:.3f}",
         .terminal =
             TerminalView{
                 .heading = "eta atlas", .subheading = "95 %", .priority = 3, .only_when_known = true},
         .report = ReportView{.heading = "\u03b7, atlas"},
         .cell = atlas_cell},
        {.name = "efficiency_atlas_half_width",
         .unit = "1",
         .value = field<&Row::efficiency_atlas_half_width>,
         .meaning = "Half-width of the 95 % interval of efficiency_atlas"},
    };
}

/// The theory at the friction of the layer.
std::vector<Column> layer_columns() {
    return {
        {.name = "friction_layer",
         .unit = "1",
         .value = field<&Row::friction_layer>,
         .meaning = "Friction coefficient of the layer as a whole, from 'vibrotrough friction-test'",
         .format = "{:.3f}",
         .terminal = TerminalView{.heading = "mu layer", .priority = 4, .only_when_known = true},
         .report = ReportView{.heading = "\u03bc, layer"}},
        {.name = "friction_layer_low",
         .unit = "1",
         .value = field<&Row::friction_layer_low>,
         .meaning = "Lower end of the confidence interval of friction_layer"},
        {.name = "friction_layer_high",
         .unit = "1",
         .value = field<&Row::friction_layer_high>,
         .meaning = "Upper end of the confidence interval of friction_layer"},
        {.name = "efficiency_theory_layer",
         .unit = "1",
         .value = field<&Row::efficiency_theory_layer>,
         .meaning = "Velocity efficiency of the plastic point mass at friction_layer",
         .format = "{:.3f}",
         .terminal = TerminalView{.heading = "eta theory",
                                  .subheading = "at mu layer",
                                  .priority = 6,
                                  .only_when_known = true},
         .report = ReportView{.heading = "\u03b7, theory at layer's \u03bc"}},
        {.name = "mode_theory_layer",
         .unit = "1",
         .value = field<&Row::mode_theory_layer>,
         .meaning = "Mode of the point mass at friction_layer"},
    };
}

/// How layer and point mass differ and move.
std::vector<Column> mode_columns() {
    return {
        {.name = "difference",
         .unit = "1",
         .value = difference,
         .meaning = "efficiency minus efficiency_theory",
         .format = "{:+.3f}",
         .in_data = false,
         .terminal = TerminalView{.heading = "difference", .priority = always_shown},
         .report = ReportView{.heading = "difference"},
         .colour = difference_colour},
        {.name = "mode_theory",
         .unit = "1",
         .value = field<&Row::mode_theory>,
         .meaning =
             "Mode of the plastic point mass: the phases of a period in order, P positive slide, N negative "
             "slide, R rest, F flight; a prime marks the slide right after a landing",
         .terminal = TerminalView{.heading = "mode", .subheading = "theory", .priority = 5},
         .report = ReportView{.heading = "mode, theory"}},
        {.name = "mode_theory_restitution",
         .unit = "1",
         .value = field<&Row::mode_theory_restitution>,
         .meaning =
             "Mode of the point mass with restitution, its first 20 phases; unknown when its motion has no "
             "period"},
        {.name = "layer_mode",
         .unit = "1",
         .value = field<&Row::layer_mode>,
         .meaning = "Mode of the simulated layer as a whole, in the same letters",
         .terminal =
             TerminalView{.heading = "mode", .subheading = "layer", .priority = 5, .only_when_known = true},
         .report = ReportView{.heading = "mode, layer"}},
    };
}

std::vector<Column> run_columns() {
    return {
        {.name = "outcome",
         .unit = "1",
         .value = field<&Row::outcome>,
         .meaning = "How the case ended, or what it waits for",
         .terminal = TerminalView{.heading = "outcome", .priority = 6, .flush_left = true},
         .report = ReportView{.heading = "outcome"},
         .colour = outcome_colour},
        {.name = "not_covered",
         .unit = "1",
         .value = field<&Row::not_covered>,
         .meaning = "What the case asks for under [engine] and the engine's certificate does not cover; "
                    "unknown when there is nothing",
         .terminal = TerminalView{.heading = "not covered",
                                  .subheading = "by certificate",
                                  .priority = always_shown,
                                  .flush_left = true,
                                  .only_when_known = true},
         .report = ReportView{.heading = "not covered by the engine's certificate"}},
        {.name = "soft",
         .unit = "1",
         .value = field<&Row::soft>,
         .meaning =
             "\"soft\" when Young's modulus is too low for the depth and the drive of the layer, so that "
             "efficiency is probably wrong by more than half of measure.half_width; unknown otherwise",
         .terminal = TerminalView{.heading = "grains",
                                  .subheading = "too soft",
                                  .priority = always_shown,
                                  .flush_left = true,
                                  .only_when_known = true},
         .report = ReportView{.heading = "grains too soft"}},
    };
}

std::string budget_cell(Row const& row) {
    auto const statistical = row.number("efficiency_half_width_statistics"),
               numerical = row.number("efficiency_numerics");
    if (!statistical || !numerical) return efficiency_cell(row);
    return core::three_digits(row.number("efficiency")) + " +- " + core::three_digits(statistical) + " +- " +
           core::three_digits(numerical) + (is_expected(row) ? "*" : "");
}

std::string larger_error_colour(Row const& row) {
    return larger_error(row) == "numerical" ? "\x1b[1m" : "";
}

/// A function that stands for the type of the values of a quantity.
Column::Function type_of(store::CaseNumber const& value) {
    constexpr auto nothing = []<typename Type>(Type const&) {
        return +[](Row const&) -> std::optional<Type> { return {}; };
    };
    if (std::holds_alternative<int>(value)) return nothing(0);
    if (std::holds_alternative<std::string>(value)) return nothing(std::string());
    return nothing(0.0);
}

/// The columns of quantities, one for each of their views.
std::vector<Column> measured_columns() {
    std::vector<Column> columns;
    auto const& quantities = measured_quantities();
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        store::Quantity const& one = *quantities[i];
        for (store::View const& view : one.views) {
            std::string const unit(view.unit.empty() ? one.units : view.unit);
            columns.push_back({.name = std::string(one.name) + unit_suffix(unit),
                               .unit = unit,
                               .value = type_of(one.type_of_case()),
                               .meaning = one.meaning_of_case(),
                               .format = view.format,
                               .terminal = view.terminal,
                               .report = view.report,
                               .measured = static_cast<int>(i),
                               .unit_factor = view.factor});
        }
    }
    return columns;
}

}  // namespace

std::string unit_suffix(std::string_view unit) {
    if (unit == "1") return "";
    std::string suffix = "_";
    for (char const c : unit) {
        if (c == '/')
            suffix += suffix.find("_per_") == suffix.npos ? "_per_" : "_";
        else
            suffix += c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return suffix;
}

std::vector<Column> budget_columns(std::span<Column const> all) {
    std::vector<Column> columns(all.begin(), all.end());
    for (Column& column : columns) {
        if (column.name == "efficiency") {
            column.terminal->subheading = "+- stat. +- num.";
            column.cell = budget_cell;
        } else if (column.name == "larger_error") {
            column.terminal = TerminalView{.heading = "larger", .subheading = "error", .priority = 8};
            column.colour = larger_error_colour;
        }
    }
    return columns;
}

std::optional<Value> Column::of(Row const& row) const {
    auto const at = [](std::vector<std::optional<Value>> const& values, int index) {
        auto const i = static_cast<std::size_t>(index);
        return i < values.size() ? values[i] : std::nullopt;
    };
    if (swept >= 0) return at(row.swept, swept);
    if (own >= 0) return at(row.own, own);
    if (observed >= 0) return at(row.observed, observed);
    if (measured >= 0) {
        auto known = row.measured.at(static_cast<std::size_t>(measured));
        if (known && std::holds_alternative<double>(*known)) known = unit_factor * std::get<double>(*known);
        return known;
    }
    return std::visit(
        [&row](auto const function) -> std::optional<Value> {
            if (auto known = function(row)) return Value(*std::move(known));
            return {};
        },
        value);
}

std::string Column::shown(Row const& row) const {
    auto const known = of(row);
    if (!known) return "-";
    if (auto const* const number = std::get_if<double>(&*known))
        return core::without_sign_of_zero(fmt::format(fmt::runtime(format), factor * *number));
    return std::visit([this](auto const& one) { return fmt::format(fmt::runtime(format), one); }, *known);
}

std::span<Column const> all_columns() {
    static std::vector<Column> const columns = [] {
        std::vector<Column> all = drive_columns();
        auto const add = [&](std::vector<Column> const& part) {
            all.insert(all.end(), part.begin(), part.end());
        };
        for (Column const& column : measured_columns()) {
            if (column.name == "efficiency_by_normal_force") {
                add(theory_columns());
                add(model_columns());
            }
            if (column.name == "conveying_speed_m_per_s") {
                add(layer_columns());
                add(mode_columns());
            }
            all.push_back(column);
        }
        add(run_columns());
        set_cells(all);
        return all;
    }();
    return columns;
}

}  // namespace vibrotrough::compare
