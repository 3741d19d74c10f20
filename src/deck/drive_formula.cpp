#include "deck/drive_formula.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::deck {
namespace {

constexpr std::size_t harmonics_per_line = 5;

std::string sine(scenario::DriveTerm const& term, std::string_view angle) {
    std::string argument =
        term.order == 1 ? fmt::format("v_{}", angle) : fmt::format("{}*v_{}", term.order, angle);
    // The engine does not accept a minus sign after a plus sign.
    if (term.phase > 0) argument += fmt::format("+{}", term.phase);
    if (term.phase < 0) argument += fmt::format("-{}", -term.phase);
    return fmt::format("sin({})", argument);
}

/// The sum of a series in lines of a few harmonics.
/// @param factor  what the amplitude of a term is multiplied with
template <typename Factor>
DriveFormula write_sum(std::vector<scenario::DriveTerm> const& terms, std::string const& name,
                       Factor const& factor) {
    DriveFormula formula;
    for (std::size_t first = 0; first < terms.size(); first += harmonics_per_line) {
        Formula line{fmt::format("{}{}", name, first / harmonics_per_line + 1), {}};
        for (std::size_t i = first; i < std::min(terms.size(), first + harmonics_per_line); ++i) {
            line.expression +=
                fmt::format("{}({})*({})", i == first ? "" : "+", terms[i].amplitude, factor(terms[i]));
        }
        formula.speed += (first == 0 ? "v_" : "+v_") + line.name;
        formula.terms.push_back(std::move(line));
    }
    return formula;
}

}  // namespace

DriveFormula drive_formula(std::vector<scenario::DriveTerm> const& terms, std::string const& axis) {
    DriveFormula formula = write_sum(terms, "step_" + axis, [](scenario::DriveTerm const& term) {
        return sine(term, "angle") + "-" + sine(term, "angle_before");
    });
    formula.speed = formula.terms.empty() ? "0" : fmt::format("({})/dt", formula.speed);
    return formula;
}

DriveFormula displacement_formula(std::vector<scenario::DriveTerm> const& terms, std::string const& name,
                                  std::string const& angle) {
    DriveFormula formula = write_sum(terms, name, [&](scenario::DriveTerm const& term) {
        return fmt::format("{}-({})", sine(term, angle), std::sin(term.phase));
    });
    if (formula.terms.empty()) formula.speed = "0";
    return formula;
}

SineMover sine_mover(std::vector<scenario::DriveTerm> const& terms, double time_step, int steps_per_cycle) {
    double const step = 2 * std::numbers::pi / steps_per_cycle;
    std::vector<double> amplitudes, phases, periods;
    for (scenario::DriveTerm const& term : terms) {
        double const half = term.order * step / 2;
        amplitudes.push_back(term.amplitude * std::sin(half) / half);
        phases.push_back(term.phase - half - std::numbers::pi / 2);
        periods.push_back(time_step * steps_per_cycle / term.order);
    }
    return {fmt::format("{}", fmt::join(amplitudes, " ")), fmt::format("{}", fmt::join(phases, " ")),
            fmt::format("{}", fmt::join(periods, " "))};
}

}  // namespace vibrotrough::deck
