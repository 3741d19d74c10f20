#pragma once

#include "deck/check.hpp"

#include <vector>

/// @file
/// What is checked of the motion of the trough.

namespace vibrotrough::deck {

/// The mesh moves through the periodic box; nodes that leave it on one side enter on the other.
void check_stroke(std::vector<Finding>& findings, prepare::PreparedCase const& c);

/// Numbers that hardly any machine or material has. They are told only where they are unusual, with the slip
/// of a unit that would explain it.
void check_unusual(std::vector<Finding>& findings, prepare::PreparedCase const& c);

/// Gravity that exceeds friction, told only where it does: by the theory the layer runs away.
void check_grip(std::vector<Finding>& findings, prepare::PreparedCase const& c);

/// The noise of a record grows with the square of the order when it is taken for a motion.
void check_record(std::vector<Finding>& findings, prepare::PreparedCase const& c);

}  // namespace vibrotrough::deck
