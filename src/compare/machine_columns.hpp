#pragma once

#include "compare/columns.hpp"

#include <vector>

namespace vibrotrough::compare {

/// The columns that describe the drive of a case. They are the first of all_columns().
std::vector<Column> drive_columns();

/// The columns of what the layer carries and does to the machine, from the simulation.
std::vector<Column> machine_columns();

}  // namespace vibrotrough::compare
