#include "compare/columns.hpp"

#include "compare/machine_columns.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

/// The value of a member of Row, which may be optional.
template <auto member>
constexpr auto field = +[](Row const& row) { return std::optional(row.*member); };

std::optional<double> difference(Row const& row) {
    if (!row.efficiency_dem || !row.efficiency_theory) return {};
    return *row.efficiency_dem - *row.efficiency_theory;
}

/// The mean of a member of Row that is an interval.
template <auto member>
constexpr auto mean = +[](Row const& row) -> std::optional<double> {
    if (!(row.*member)) return {};
    return (row.*member)->mean;
};

/// The half-width of a member of Row that is an interval.
template <auto member>
constexpr auto half_width = +[](Row const& row) -> std::optional<double> {
    if (!(row.*member)) return {};
    return (row.*member)->half_width;
};

std::string three_digits(std::optional<double> const& value) {
    return value ? fmt::format("{:.3f}", *value) : "-";
}

std::string efficiency_cell(Row const& row) {
    if (!row.efficiency_dem || !row.whole_half_width) return three_digits(row.efficiency_dem);
    return three_digits(row.efficiency_dem) + " +- " + three_digits(row.whole_half_width);
}

std::string cycles_cell(Row const& row) {
    if (!row.cycles_measured || !row.cycles_discarded) return "-";
    return fmt::format("{}+{}", *row.cycles_discarded, *row.cycles_measured);
}

/// Colours that the colour-blind tell apart: yellow where the layer is faster than the theory, cyan where it
/// is slower, bold from 0.1 on; none within the confidence interval.
std::string difference_colour(Row const& row) {
    auto const value = difference(row);
    if (!value || std::abs(*value) <= row.whole_half_width.value_or(0.0)) return {};
    return fmt::format("\x1b[{}{}m", std::abs(*value) >= 0.1 ? "1;" : "", *value > 0 ? 33 : 36);
}

std::string outcome_colour(Row const& row) {
    auto const outcome = core::outcome_named(row.outcome);  // none while the case has not ended
    bool const is_fine =
        !outcome || *outcome == core::Outcome::finished || *outcome == core::Outcome::interrupted;
    return is_fine ? "" : "\x1b[31m";
}

std::vector<Column> efficiency_columns() {
    return {
        {.name = "efficiency_dem",
         .unit = "1",
         .value = field<&Row::efficiency_dem>,
         .meaning = "Velocity efficiency \u03b7 of the simulated layer: its mean velocity relative to the "
                    "trough over \u03c9 r cos \u03b2; unknown unless the layer became steady",
         .format = "{:.3f}",
         .position = 70,
         .terminal = TerminalView{.heading = "eta DEM", .priority = always_shown, .cell = efficiency_cell},
         .report = ReportView{.heading = "\u03b7, DEM"}},
        {.name = "efficiency_dem_half_width",
         .unit = "1",
         .value = field<&Row::efficiency_dem_half_width>,
         .meaning =
             "Half-width of the confidence interval of efficiency_dem over all packings: statistics alone",
         .format = "{:.3f}",
         .position = 80,
         .report = ReportView{.heading = "\u00b1 statistical"}},
        {.name = "efficiency_dem_whole_half_width",
         .unit = "1",
         .value = field<&Row::whole_half_width>,
         .meaning =
             "Half-width of efficiency_dem for statistics and numerics together: the root of the sum of "
             "squares of efficiency_dem_half_width and efficiency_dem_numerical_error",
         .format = "{:.3f}",
         .position = 87,
         .report = ReportView{.heading = "\u00b1 together"}},
        {.name = "speed_dem_m_per_s",
         .unit = "m/s",
         .value = mean<&Row::speed_dem>,
         .meaning = "Conveying speed of the simulated layer: efficiency_dem times \u03c9 r cos \u03b2",
         .format = "{:.3f}",
         .position = 160,
         .terminal = TerminalView{.heading = "speed", .subheading = "m/s", .priority = 4},
         .report = ReportView{.heading = "speed"}},
        {.name = "speed_dem_half_width_m_per_s",
         .unit = "m/s",
         .value = half_width<&Row::speed_dem>,
         .meaning = "Half-width of speed_dem_m_per_s, for statistics and numerics together",
         .format = "{:.3f}",
         .position = 161},
        {.name = "efficiency_theory",
         .unit = "1",
         .value = field<&Row::efficiency_theory>,
         .meaning = "Velocity efficiency of the plastic point mass at the friction of a grain on the trough; "
                    "unknown when it has no mean speed",
         .format = "{:.3f}",
         .position = 90,
         .terminal = TerminalView{.heading = "eta theory", .subheading = "at mu", .priority = 7},
         .report = ReportView{.heading = "\u03b7, theory"}},
        {.name = "efficiency_rolling_layer",
         .unit = "1",
         .value = field<&Row::efficiency_rolling_layer>,
         .meaning =
             "Velocity efficiency of the rolling-layer law with its published constants, for spheres "
             "that may rotate; unknown outside the throw numbers, slopes, frictions and depths at which "
             "the law has been tested",
         .format = "{:.3f}",
         .position = 95,
         .terminal =
             TerminalView{
                 .heading = "eta rolling", .subheading = "layer law", .priority = 2, .only_when_known = true},
         .report = ReportView{.heading = "\u03b7, rolling layer"}},
        {.name = "mode_theory",
         .unit = "1",
         .value = field<&Row::mode_theory>,
         .meaning = "Mode of that point mass: the phases of a period in order, P positive slide, N negative "
                    "slide, R rest, F flight; a prime marks the slide right after a landing",
         .position = 140,
         .terminal = TerminalView{.heading = "mode", .subheading = "theory", .priority = 5},
         .report = ReportView{.heading = "mode, theory"}},
        {.name = "mode_layer",
         .unit = "1",
         .value = field<&Row::mode_layer>,
         .meaning = "Mode of the simulated layer as a whole, in the same letters",
         .position = 150,
         .terminal =
             TerminalView{.heading = "mode", .subheading = "layer", .priority = 5, .only_when_known = true},
         .report = ReportView{.heading = "mode, layer"}},
    };
}

std::vector<Column> friction_columns() {
    return {
        {.name = "efficiency_normal_force",
         .unit = "1",
         .value = field<&Row::efficiency_by_normal_force>,
         .meaning = "Velocity efficiency of a point mass with the friction of a grain under the normal force "
                    "that the layer itself exerts; unknown with side walls",
         .format = "{:.3f}",
         .position = 100,
         .terminal =
             TerminalView{
                 .heading = "eta point", .subheading = "its force", .priority = 3, .only_when_known = true}},
        {.name = "landing_friction",
         .unit = "1",
         .value = field<&Row::landing_friction>,
         .meaning = "Tangential over normal impulse while the layer lands; unknown without landings and with "
                    "side walls"},
        {.name = "friction_layer",
         .unit = "1",
         .value = field<&Row::friction_layer>,
         .meaning = "Friction coefficient of the layer as a whole, from 'vibrotrough friction-test'",
         .format = "{:.3f}",
         .position = 110,
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
         .position = 120,
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

std::vector<Column> run_columns() {
    return {
        {.name = "packings",
         .unit = "1",
         .value = field<&Row::packings>,
         .meaning = "Number of independent packings that the confidence interval rests on"},
        {.name = "cycles_measured",
         .unit = "1",
         .value = field<&Row::cycles_measured>,
         .meaning = "Cycles kept for the mean, all packings together",
         .position = 170,
         .terminal =
             TerminalView{.heading = "cycles", .subheading = "cut+kept", .priority = 2, .cell = cycles_cell},
         .report = ReportView{.heading = "cycles kept"}},
        {.name = "cycles_discarded",
         .unit = "1",
         .value = field<&Row::cycles_discarded>,
         .meaning = "Cycles discarded as start-up, all packings together",
         .position = 180,
         .report = ReportView{.heading = "discarded"}},
        {.name = "wall_s",
         .unit = "s",
         .value = field<&Row::wall_s>,
         .meaning = "Wall time of the engine, all packings together",
         .format = "{:.0f}",
         .position = 190,
         .report = ReportView{.heading = "wall time"}},
        {.name = "outcome",
         .unit = "1",
         .value = field<&Row::outcome>,
         .meaning = "How the case ended, or what it waits for",
         .position = 200,
         .terminal =
             TerminalView{.heading = "outcome", .priority = 6, .flush_left = true, .colour = outcome_colour},
         .report = ReportView{.heading = "outcome"}},
        {.name = "not_covered",
         .unit = "1",
         .value = field<&Row::not_covered>,
         .meaning = "What the case asks for under [engine] and the engine's certificate does not cover; "
                    "unknown when there is nothing",
         .position = 210,
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
             "efficiency_dem is probably wrong by more than half of measure.half_width; unknown otherwise",
         .position = 205,
         .terminal = TerminalView{.heading = "grains",
                                  .subheading = "too soft",
                                  .priority = always_shown,
                                  .flush_left = true,
                                  .only_when_known = true},
         .report = ReportView{.heading = "grains too soft"}},
        {.name = "difference",
         .unit = "1",
         .value = difference,
         .meaning = "efficiency_dem minus efficiency_theory",
         .format = "{:+.3f}",
         .position = 130,
         .in_data = false,
         .terminal =
             TerminalView{.heading = "difference", .priority = always_shown, .colour = difference_colour},
         .report = ReportView{.heading = "difference"}},
    };
}

std::vector<Column> numerics_columns() {
    return {
        {.name = "efficiency_dem_numerical_error",
         .unit = "1",
         .value = field<&Row::numerical_error>,
         .meaning = "Numerical error of efficiency_dem by soft grains, box and time step: as 'vibrotrough "
                    "convergence' measured it, else its bound at 95 %",
         .format = "{:.3f}",
         .position = 82,
         .report = ReportView{.heading = "\u00b1 numerical"}},
        {.name = "numerical_error_case",
         .unit = "1",
         .value = field<&Row::numerical_error_case>,
         .meaning = "Case that was studied for efficiency_dem_numerical_error: this one, or the nearest one "
                    "that was; unknown for a bound",
         .position = 84,
         .report = ReportView{.heading = "numerical error of case"}},
        {.name = "larger_error",
         .unit = "1",
         .value = larger_error,
         .meaning = "Which error of efficiency_dem is larger: statistical (efficiency_dem_half_width) or "
                    "numerical",
         .position = 86,
         .report = ReportView{.heading = "larger error"}},
    };
}

std::string budget_cell(Row const& row) {
    if (!row.efficiency_dem_half_width || !row.numerical_error) return efficiency_cell(row);
    return three_digits(row.efficiency_dem) + " +- " + three_digits(row.efficiency_dem_half_width) + " +- " +
           (is_bound(row) ? "<" : "") + three_digits(row.numerical_error) + (is_borrowed(row) ? "*" : "");
}

std::string larger_error_colour(Row const& row) {
    return larger_error(row) == "numerical" ? "\x1b[1m" : "";
}

}  // namespace

std::vector<Column> budget_columns(std::span<Column const> all) {
    std::vector<Column> columns(all.begin(), all.end());
    for (Column& column : columns) {
        if (column.name == "efficiency_dem") {
            column.terminal->subheading = "+- stat. +- num.";
            column.terminal->cell = budget_cell;
        } else if (column.name == "larger_error") {
            column.terminal = TerminalView{
                .heading = "larger", .subheading = "error", .priority = 8, .colour = larger_error_colour};
        }
    }
    return columns;
}

std::optional<Value> Column::of(Row const& row) const {
    if (swept >= 0) {
        auto const place = static_cast<std::size_t>(swept);
        return place < row.swept.size() ? row.swept[place] : std::nullopt;
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
        return fmt::format(fmt::runtime(format), factor * *number);
    return std::visit([this](auto const& one) { return fmt::format(fmt::runtime(format), one); }, *known);
}

std::span<Column const> all_columns() {
    static std::vector<Column> const columns = [] {
        std::vector<Column> all;
        for (auto const& part : {drive_columns(), efficiency_columns(), machine_columns(), friction_columns(),
                                 run_columns(), numerics_columns()})
            all.insert(all.end(), part.begin(), part.end());
        return all;
    }();
    return columns;
}

}  // namespace vibrotrough::compare
