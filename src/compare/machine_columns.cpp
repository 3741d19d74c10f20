#include "compare/machine_columns.hpp"

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

constexpr double hours = 3.6;  // t/h in kg/s

/// The value of a member of Row, which may be optional.
template <auto member>
constexpr auto field = +[](Row const& row) { return std::optional(row.*member); };

std::optional<double> stroke(Row const& row) {
    return 2e3 * row.amplitude_m;
}

std::optional<double> turns_per_minute(Row const& row) {
    return 60 * row.frequency_hz;
}

/// The mean of an interval of Row in a unit that is 1 / `factor` of that of the row.
template <auto member, double const& factor>
constexpr auto mean = +[](Row const& row) -> std::optional<double> {
    if (!(row.*member)) return {};
    return factor * (row.*member)->mean;
};

/// The half-width of an interval of Row in the same unit.
template <auto member, double const& factor>
constexpr auto half_width = +[](Row const& row) -> std::optional<double> {
    if (!(row.*member) || !(row.*member)->half_width) return {};
    return factor * *(row.*member)->half_width;
};

constexpr double once = 1;

std::string interval_cell(std::optional<Interval> const& flow) {
    if (!flow) return "-";
    std::string const mean = fmt::format("{:.3g}", hours * flow->mean);
    return flow->half_width ? fmt::format("{} +- {:.2g}", mean, hours * *flow->half_width) : mean;
}

std::string flow_cell(Row const& row) {
    return interval_cell(row.mass_flow);
}

std::string flow_per_width_cell(Row const& row) {
    return interval_cell(row.mass_flow_per_width);
}

}  // namespace

std::vector<Column> drive_columns() {
    return {
        {.name = "case",
         .unit = "1",
         .value = field<&Row::id>,
         .meaning = "Case id: a hash of the scenario, the deck and the engine's version",
         .position = 10,
         .terminal = TerminalView{.heading = "case", .priority = always_shown, .flush_left = true},
         .report = ReportView{.heading = "case"}},
        {.name = "throw_number",
         .unit = "1",
         .value = field<&Row::throw_number>,
         .meaning = "Throw number \u0393 = \u03c9\u00b2 r sin \u03b2 / (g cos \u03b1)",
         .format = "{:.3f}",
         .position = 20,
         .terminal = TerminalView{.heading = "Gamma", .priority = 8},
         .report = ReportView{.heading = "throw number \u0393", .once_when_same = true},
         .key = "trough.throw_number"},
        {.name = "machine_number",
         .unit = "1",
         .value = field<&Row::machine_number>,
         .meaning = "Machine number K = \u03c9\u00b2 r / g",
         .format = "{:.3f}",
         .position = 25,
         .key = "trough.machine_number"},
        {.name = "vibration_angle_deg",
         .unit = "degree",
         .value = field<&Row::vibration_angle_deg>,
         .meaning = "Vibration angle \u03b2 between the direction of vibration and the trough",
         .format = "{:.2f}",
         .position = 30,
         .terminal = TerminalView{.heading = "beta", .subheading = "deg", .priority = 5},
         .report = ReportView{.heading = "\u03b2", .once_when_same = true},
         .key = "trough.vibration_angle"},
        {.name = "inclination_deg",
         .unit = "degree",
         .value = field<&Row::inclination_deg>,
         .meaning = "Inclination \u03b1 of the trough, positive when it conveys uphill",
         .format = "{:.2f}",
         .position = 40,
         .terminal = TerminalView{.heading = "alpha", .subheading = "deg", .priority = 3},
         .report = ReportView{.heading = "\u03b1", .once_when_same = true},
         .key = "trough.inclination"},
        {.name = "friction",
         .unit = "1",
         .value = field<&Row::friction>,
         .meaning = "Friction coefficient \u03bc of a grain on the trough",
         .format = "{:.3g}",
         .position = 50,
         .terminal = TerminalView{.heading = "mu", .priority = 4},
         .report = ReportView{.heading = "\u03bc", .once_when_same = true},
         .key = "trough.friction"},
        {.name = "amplitude_m",
         .unit = "m",
         .value = field<&Row::amplitude_m>,
         .meaning = "Amplitude r in the direction of vibration, half the stroke",
         .format = "{:.4g}",
         .position = 55,
         .key = "trough.amplitude",
         .factor = 1e3,
         .shown_unit = "mm"},
        {.name = "stroke_mm",
         .unit = "mm",
         .value = stroke,
         .meaning = "Stroke 2 r, between the ends of the vibration",
         .format = "{:.4g}",
         .position = 56,
         .report = ReportView{.heading = "stroke", .once_when_same = true},
         .key = "trough.stroke"},
        {.name = "frequency_hz",
         .unit = "Hz",
         .value = field<&Row::frequency_hz>,
         .meaning = "Frequency of the vibration",
         .format = "{:.2f}",
         .position = 60,
         .terminal = TerminalView{.heading = "f", .subheading = "Hz", .priority = 1},
         .report = ReportView{.heading = "frequency", .once_when_same = true},
         .key = "trough.frequency"},
        {.name = "turns_per_minute",
         .unit = "1/minute",
         .value = turns_per_minute,
         .meaning = "Cycles of the vibration per minute, which are turns of an unbalanced or a crank drive",
         .format = "{:.0f}",
         .position = 62,
         .report = ReportView{.heading = "turns", .once_when_same = true}},
    };
}

std::vector<Column> machine_columns() {
    return {
        {.name = "mass_flow_t_per_h",
         .unit = "t/h",
         .value = mean<&Row::mass_flow, hours>,
         .meaning =
             "Mass flow of the simulated layer on the whole width of the trough (trough.width, or between "
             "side walls); unknown without a width",
         .format = "{:.3g}",
         .position = 164,
         .terminal = TerminalView{.heading = "mass flow",
                                  .subheading = "t/h",
                                  .priority = 6,
                                  .only_when_known = true,
                                  .cell = flow_cell},
         .report = ReportView{.heading = "mass flow"}},
        {.name = "mass_flow_half_width_t_per_h",
         .unit = "t/h",
         .value = half_width<&Row::mass_flow, hours>,
         .meaning = "Half-width of the confidence interval of mass_flow_t_per_h",
         .format = "{:.2g}",
         .position = 165,
         .report = ReportView{.heading = "\u00b1 mass flow"}},
        {.name = "mass_flow_kg_per_s",
         .unit = "kg/s",
         .value = mean<&Row::mass_flow, once>,
         .meaning = "The same mass flow in kg/s"},
        {.name = "mass_flow_half_width_kg_per_s",
         .unit = "kg/s",
         .value = half_width<&Row::mass_flow, once>,
         .meaning = "Half-width of the confidence interval of mass_flow_kg_per_s"},
        {.name = "mass_flow_per_width_t_per_h_m",
         .unit = "t/h/m",
         .value = mean<&Row::mass_flow_per_width, hours>,
         .meaning = "Mass flow of the simulated layer per metre of width: speed times mass per area",
         .format = "{:.3g}",
         .position = 166,
         .terminal = TerminalView{.heading = "mass flow",
                                  .subheading = "t/h per m",
                                  .priority = 2,
                                  .only_when_known = true,
                                  .cell = flow_per_width_cell},
         .report = ReportView{.heading = "mass flow per width"}},
        {.name = "mass_flow_per_width_half_width_t_per_h_m",
         .unit = "t/h/m",
         .value = half_width<&Row::mass_flow_per_width, hours>,
         .meaning = "Half-width of the confidence interval of mass_flow_per_width_t_per_h_m"},
        {.name = "power_per_area_w_per_m2",
         .unit = "W/m2",
         .value = field<&Row::power_per_area>,
         .meaning = "Mean power that the trough gives to the layer, per area of trough",
         .format = "{:.3g}",
         .position = 167,
         .report = ReportView{.heading = "power per area"}},
        {.name = "added_mass_per_area_kg_per_m2",
         .unit = "kg/m2",
         .value = field<&Row::added_mass_per_area>,
         .meaning = "Mass by which the layer loads the vibrating machine, per area of trough, from the first "
                    "harmonic of its force in phase with the acceleration; may be negative"},
        {.name = "added_mass_fraction",
         .unit = "1",
         .value = field<&Row::added_mass_fraction>,
         .meaning = "The same over the mass of the layer: 1 when the layer moves as a part of the trough",
         .format = "{:.3f}",
         .position = 168,
         .report = ReportView{.heading = "added mass / mass"}},
        {.name = "damping_per_area_n_s_per_m3",
         .unit = "N s/m3",
         .value = field<&Row::damping_per_area>,
         .meaning =
             "Damping by which the layer loads the vibrating machine, per area of trough, from the first "
             "harmonic of its force in phase with the velocity",
         .format = "{:.3g}",
         .position = 169,
         .report = ReportView{.heading = "damping per area"}},
    };
}

}  // namespace vibrotrough::compare
