#pragma once

#include <limits>
#include <numbers>

// Internal to this module.
namespace vibrotrough::measure {

inline constexpr double two_pi = 2 * std::numbers::pi;                   ///< rad, a cycle
inline constexpr double gap = std::numeric_limits<double>::quiet_NaN();  ///< in a curve

}  // namespace vibrotrough::measure
