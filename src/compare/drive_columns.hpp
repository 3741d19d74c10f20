#pragma once

#include "compare/columns.hpp"

#include <vector>

namespace vibrotrough::compare {

/// The columns that describe the drive of a case. They are the first of all_columns().
std::vector<Column> drive_columns();

}  // namespace vibrotrough::compare
