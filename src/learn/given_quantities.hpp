#pragma once

#include "learn/calibration.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

// Internal to this room.
namespace vibrotrough::learn {

/// Checks what is free and what is fixed in a model of measured speeds.
/// @param known  the quantities of the model
/// @param whose  names the model in errors, such as "the point mass"
/// @throws core::InputError when a name is unknown or given twice, or a measurement has no vibration angle
/// and none is given for all
void check_given(std::vector<std::string> const& free, std::map<std::string, double> const& fixed,
                 std::vector<FreeParameter> const& known, std::string_view whose,
                 std::vector<MeasuredSpeed> const& speeds);

}  // namespace vibrotrough::learn
