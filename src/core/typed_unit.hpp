#pragma once

#include <string>
#include <string_view>

/// @file
/// What a message says of a quantity in the unit in which the user wrote it.

namespace vibrotrough::core {

/// A range in the unit of a text: "0.6 to 600000 rpm" for "7e5 rpm", from ends in Hz.
/// @param text  a number with a unit of the same dimension as `unit`
/// @param low, high  ends of the range in `unit`, finite
/// @param between    what stands between both ends
/// @throws QuantityError as parse_quantity
std::string range_in_unit_of(std::string_view text, double low, double high, std::string const& unit,
                             std::string_view between = " to ");

/// The slip of a unit that explains a number outside of a range, " (were 9.7 mm meant?)" for "9.7 m": the
/// number lies within the range with another unit that people use for the quantity. Empty where none does.
/// @throws QuantityError as parse_quantity
std::string slip_of_unit(std::string_view text, double low, double high, std::string const& unit);

}  // namespace vibrotrough::core
