#pragma once

#include "store/schema.hpp"

#include <vector>

/// @file
/// What is known of the materials of a mixture. It follows from the cycles of the packings and the scenario.

namespace vibrotrough::store {

/// The tables of each packing of a mixture.
std::vector<PackingTable> material_tables();

/// The tables of the case: each material, each in each bin of an open trough, and the segregation over time.
std::vector<CaseTable> materials_case_tables();

/// Fills in what the packings of a mixture have in their records beside their cycles, of which the start-up
/// is known.
void add_materials(CaseRecord& record);

/// The quantities of a mixture, of the first of [[materials]]; without one they have no value.
std::vector<Quantity> material_quantities();

}  // namespace vibrotrough::store
