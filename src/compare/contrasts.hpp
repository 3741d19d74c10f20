#pragma once

#include "compare/compared_cases.hpp"

#include <string_view>
#include <vector>

namespace vibrotrough::compare {

/// A row for each case but this one: its velocity efficiency less that of this one, in contrast_columns().
/// @throws core::InputError when there is no such case
std::vector<Row> contrast_rows_against(ComparedCases const& compared, std::string_view case_id);

/// A row for each case that has the same swept keys as an earlier one but for this key: its velocity
/// efficiency less that of the first of them.
/// @param key  swept key of the campaign file, in full or without its section where that is unique
/// @throws core::InputError when the key is not swept
std::vector<Row> contrast_rows_of(campaign::Plan const& plan, ComparedCases const& compared,
                                  std::string_view key);

/// The columns of these rows: the case and its swept keys, the difference with its interval, and whether it
/// is significant.
std::vector<Column> contrast_columns(std::span<Column const> columns, scenario::SweptKeys const& swept);

/// Bound of the error of a difference of velocity efficiencies by the numerical settings of two cases. The
/// errors cancel where the cases have the same box, time step and modulus and differ in material keys alone,
/// as src/manual/howto/compare.md says; all others add as the root of the sum of squares.
/// @return nothing when the numerical errors of neither are known
std::optional<double> numerics_of_difference(scenario::Scenario const& one, Row const& row_of_one,
                                             scenario::Scenario const& other, Row const& row_of_other);

}  // namespace vibrotrough::compare
