#include "compare/drive_columns.hpp"

#include <utility>

namespace vibrotrough::compare {
namespace {

std::optional<double> stroke(Row const& row) {
    return 2e3 * row.amplitude_m;
}

std::optional<double> turns_per_minute(Row const& row) {
    return 60 * row.frequency_hz;
}

/// What the trough is.
std::vector<Column> trough_columns() {
    return {
        {.name = "case",
         .unit = "1",
         .value = field<&Row::id>,
         .meaning = "Case id: a hash of the scenario, the deck and the engine's version",
         .terminal = TerminalView{.heading = "case", .priority = always_shown, .flush_left = true},
         .report = ReportView{.heading = "case"}},
        {.name = "throw_number",
         .unit = "1",
         .value = field<&Row::throw_number>,
         .meaning = "Throw number \u0393 = \u03c9\u00b2 r sin \u03b2 / (g cos \u03b1)",
         .format = "{:.3f}",
         .terminal = TerminalView{.heading = "Gamma", .priority = 8},
         .report = ReportView{.heading = "throw number \u0393", .once_when_same = true},
         .key = "trough.throw_number"},
        {.name = "machine_number",
         .unit = "1",
         .value = field<&Row::machine_number>,
         .meaning = "Machine number K = \u03c9\u00b2 r / g",
         .format = "{:.3f}",
         .key = "trough.machine_number"},
        {.name = "vibration_angle_deg",
         .unit = "degree",
         .value = field<&Row::vibration_angle_deg>,
         .meaning = "Vibration angle \u03b2 between the direction of vibration and the trough",
         .format = "{:.2f}",
         .terminal = TerminalView{.heading = "beta", .subheading = "deg", .priority = 5},
         .report = ReportView{.heading = "\u03b2", .once_when_same = true},
         .key = "trough.vibration_angle"},
        {.name = "inclination_deg",
         .unit = "degree",
         .value = field<&Row::inclination_deg>,
         .meaning = "Inclination \u03b1 of the trough, positive when it conveys uphill",
         .format = "{:.2f}",
         .terminal = TerminalView{.heading = "alpha", .subheading = "deg", .priority = 3},
         .report = ReportView{.heading = "\u03b1", .once_when_same = true},
         .key = "trough.inclination"},
        {.name = "friction",
         .unit = "1",
         .value = field<&Row::friction>,
         .meaning = "Friction coefficient \u03bc of a grain on the trough",
         .format = "{:.3g}",
         .terminal = TerminalView{.heading = "mu", .priority = 4},
         .report = ReportView{.heading = "\u03bc", .once_when_same = true},
         .key = "trough.friction"},
    };
}

/// How fast and how far it moves.
std::vector<Column> vibration_columns() {
    return {
        {.name = "amplitude_m",
         .unit = "m",
         .value = field<&Row::amplitude_m>,
         .meaning = "Amplitude r in the direction of vibration, half the stroke",
         .format = "{:.4g}",
         .key = "trough.amplitude",
         .factor = 1e3,
         .shown_unit = "mm"},
        {.name = "stroke_mm",
         .unit = "mm",
         .value = stroke,
         .meaning = "Stroke 2 r, between the ends of the vibration",
         .format = "{:.4g}",
         .report = ReportView{.heading = "stroke", .once_when_same = true},
         .key = "trough.stroke"},
        {.name = "frequency_hz",
         .unit = "Hz",
         .value = field<&Row::frequency_hz>,
         .meaning = "Frequency of the vibration",
         .format = "{:.2f}",
         .terminal = TerminalView{.heading = "f", .subheading = "Hz", .priority = 1},
         .report = ReportView{.heading = "frequency", .once_when_same = true},
         .key = "trough.frequency"},
        {.name = "turns_per_minute",
         .unit = "1/minute",
         .value = turns_per_minute,
         .meaning = "Cycles of the vibration per minute, which are turns of an unbalanced or a crank drive",
         .format = "{:.0f}",
         .report = ReportView{.heading = "turns", .once_when_same = true}},
    };
}

}  // namespace

std::vector<Column> drive_columns() {
    std::vector<Column> all = trough_columns();
    for (Column& column : vibration_columns()) all.push_back(std::move(column));
    return all;
}

}  // namespace vibrotrough::compare
