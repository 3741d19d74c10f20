#pragma once

#include "learn/uncertain.hpp"

#include <string>

namespace vibrotrough::app {

/// Reads a number that may not be exact: "0.3", with its standard uncertainty "0.3+-0.03" or "0.3 +- 0.03",
/// or anything within a range, "0.25 to 0.35". Its mean and the ends of a range lie within [low, high].
/// @throws core::InputError naming the option, its value and what to write instead
learn::Uncertain read_uncertain_number(std::string const& option, std::string const& text,
                                       std::string const& example, double low, double high);

/// The same of a quantity above zero with its unit, which may stand once: "600+-30 kg/m3".
learn::Uncertain read_uncertain_quantity(std::string const& option, std::string const& text,
                                         std::string const& unit, std::string const& example);

}  // namespace vibrotrough::app
