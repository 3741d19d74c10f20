#pragma once

#include "store/schema.hpp"

#include <vector>

/// @file
/// What is known of the stages of a drive. It follows from the cycles of the packings and the scenario.

namespace vibrotrough::store {

/// The tables of the case: each stage, of which without packings only the drive is known, and each cycle of
/// the stages.
std::vector<CaseTable> stages_case_tables();

/// Fills in what the packings of a case with stages have in their records beside their cycles.
void add_stages(CaseRecord& record);

/// The quantities of the last stage in which the trough moves, and of the last one in which it stands still;
/// without stages they have no value.
std::vector<Quantity> stage_quantities();

}  // namespace vibrotrough::store
