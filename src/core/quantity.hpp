#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace vibrotrough::core {

/// The text is not a quantity of the wanted dimension. The message is plain words, without file or key.
class QuantityError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Reads a number with a unit, such as "6 mm", and gives it in `unit` (SI), by udunits2.
///
/// @param text  a finite decimal number, optional space, a unit that udunits2 knows
/// @param unit  the unit of the result, e.g. "m", "radian", "Hz", "kg/m3", "Pa"
/// @throws QuantityError when there is no number, no unit, an unknown unit, or another dimension
double parse_quantity(std::string_view text, std::string const& unit);

}  // namespace vibrotrough::core
