#pragma once

#include "theory/conveyor.hpp"

#include <string>
#include <string_view>

// Internal to this module.
namespace vibrotrough::theory::detail {

/// The shortest text from which the same number is read back.
std::string number_text(double value);

/// A number for a message, with at most six digits.
std::string short_text(double value);

/// @throws std::invalid_argument "name = value is outside its range range" unless `good`
void require_range(bool good, std::string_view name, double value, std::string_view range);

/// @throws std::invalid_argument when an input is out of range
void check_ranges(PointMass const& input);
/// @copydoc check_ranges(PointMass const&)
void check_ranges(Conveyor const& conveyor);

/// The inputs as text from which they can be reproduced.
std::string inputs_text(PointMass const& input);
/// @copydoc inputs_text(PointMass const&)
std::string inputs_text(Conveyor const& conveyor);

}  // namespace vibrotrough::theory::detail
