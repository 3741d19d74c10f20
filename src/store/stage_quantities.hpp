#pragma once

#include "store/material_quantities.hpp"
#include "store/quantity.hpp"
#include "store/schema.hpp"

#include <vector>

/// @file
/// What is known of the stages of a drive. It follows from the cycles of the packings and the scenario.

namespace vibrotrough::store {

/// The columns of the table `stages`: one row for each stage.
std::vector<Entry> const& stages_entries();
/// Their values; none when the drive has no stages, and without packings only those of the drive.
std::vector<CaseValues> stages_table(CaseRecord const& record);

/// The columns of the table `stage_cycles`: one row for each cycle of the stages.
std::vector<Entry> const& stage_cycles_entries();
/// Their values; none when the drive has no stages.
std::vector<CaseValues> stage_cycles_table(CaseRecord const& record);

/// Fills in what the packings of a case with stages have in their records beside their cycles.
void add_stages(CaseRecord& record);

/// The quantities of the last stage in which the trough moves, and of the last one in which it stands still;
/// without stages they have no value.
std::vector<Quantity> stage_quantities();

}  // namespace vibrotrough::store
