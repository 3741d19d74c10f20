#pragma once

#include "compare/columns.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::compare {

/// The value of a member of Row, which may be optional.
template <auto member>
constexpr auto field = +[](Row const& row) { return std::optional(row.*member); };

/// The columns that describe the drive of a case. They are the first of all_columns().
std::vector<Column> drive_columns();

}  // namespace vibrotrough::compare
