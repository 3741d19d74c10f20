#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace vibrotrough::core {

/// A text is not a quantity of the wanted dimension. The message names neither file nor key; the caller adds
/// them.
class QuantityError : public std::runtime_error {
  public:
    /// @param problem  what is wrong with the text
    /// @param advice   what to write instead; empty when the caller, who knows the key, says it better
    explicit QuantityError(std::string problem, std::string advice = "")
        : std::runtime_error(advice.empty() ? problem : problem + "; " + advice),
          problem_(std::move(problem)),
          advice_(std::move(advice)) {}
    std::string const& problem() const { return problem_; }  ///< What is wrong.
    std::string const& advice() const { return advice_; }    ///< What to write instead, or nothing.

  private:
    std::string problem_, advice_;
};

/// Reads a number with a unit, such as "6 mm", and converts it to `unit` with udunits2.
///
/// Where `unit` is "Hz", a turn is a cycle: "1500 rpm", "1500 1/min", "1500 U/min" (German) and "25 turns /
/// s" are all 25 Hz. Angles ("157 rad/s") are refused there. "to" is a tonne; "ton" and "tons" are refused
/// because they mean different masses.
///
/// @param text  a finite decimal number, an optional space, and a unit that is in the udunits2 database
/// @param unit  the SI unit of the result, e.g. "m", "radian", "Hz", "kg/m3", "Pa"
/// @throws QuantityError when the number or the unit is missing, the unit is unknown, ambiguous or of another
///   dimension, or the result is not finite
double parse_quantity(std::string_view text, std::string const& unit);

/// The unit of such a text as it is written: "mm" of "6 mm". @throws QuantityError when it does not begin
/// with a number
std::string unit_of(std::string_view text);

/// Reads a number without a unit, such as "0.3", or a percentage, such as "30 %".
/// @param text  a finite decimal number
/// @throws QuantityError when it is something else; a decimal comma is named
double parse_number(std::string_view text);

}  // namespace vibrotrough::core
