#pragma once

#include "store/material_quantities.hpp"

#include <span>
#include <vector>

/// @file
/// What is known of the materials of a mixture that is fed into an open trough.

namespace vibrotrough::store {

/// The columns of the tables `material_flow`, one row for each material, and `material_along`, one row for
/// each material and bin, of each packing.
std::span<PackingTable const> material_flow_tables();

/// The columns of the table `materials_along` of a mixture in an open trough: one row for each material and
/// bin along the trough.
std::vector<Entry> const& materials_along_entries();
/// Their values; none for other cases.
std::vector<CaseValues> materials_along_table(CaseRecord const& record);

}  // namespace vibrotrough::store
