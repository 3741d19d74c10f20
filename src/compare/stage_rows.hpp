#pragma once

#include "compare/compared_cases.hpp"

#include <span>
#include <string>
#include <vector>

/// @file
/// The table of `compare --stages`: each stage of a drive beside what the theory says of its drive.

namespace vibrotrough::compare {

/// The rows of the stages of one case. The theory is that of the drive of a stage without end; it has no
/// value for a standstill.
/// @param record   of the case; without packings only its scenario counts, and the rows have no measurement
/// @param outcome  how the case ended, or what it waits for
std::vector<Row> stage_rows(std::string const& id, prepare::PreparedCase const& prepared,
                            store::CaseRecord const& record, std::string const& outcome);

/// The rows of all stages of a campaign; reads the results.
/// @throws core::InputError when no case has stages
std::vector<Row> stage_rows(ComparedCases const& compared);

/// The columns of these rows, with those of the swept keys among `columns`.
std::vector<Column> stage_columns(std::span<Column const> columns = all_columns());

}  // namespace vibrotrough::compare
