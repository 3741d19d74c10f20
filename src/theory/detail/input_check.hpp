#pragma once

#include "theory/point_mass.hpp"

#include <string>

// Internal to the room.
namespace vibrotrough::theory::detail {

/// Shortest text that reads back as the same number.
std::string number_text(double value);

/// @throws std::invalid_argument "name = value is outside its range range" unless good
void require_range(bool good, char const* name, double value, char const* range);

/// @throws std::invalid_argument when an input is out of its range
void check_ranges(PointMass const& input);

/// The inputs as text that reproduces them.
std::string described(PointMass const& input);

}  // namespace vibrotrough::theory::detail
