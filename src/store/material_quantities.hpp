#pragma once

#include "store/quantity.hpp"
#include "store/schema.hpp"

#include <span>
#include <string>
#include <variant>
#include <vector>

/// @file
/// What is known of the materials of a mixture. It follows from the cycles of the packings and the scenario.

namespace vibrotrough::store {

/// The columns of the tables of each packing of so many materials: `material_ends`, two for each of them, or
/// those of an open trough (material_flow_tables()). None for one material.
std::span<PackingTable const> material_tables(std::size_t materials, bool open);

/// The values of a column of a table of the case.
using CaseValues = std::variant<std::vector<double>, std::vector<std::string>>;

/// The columns of the table `materials` of a mixture: one row for each material, that of [grains] first.
std::vector<Entry> const& materials_entries();
/// Their values; none when the case is no mixture.
std::vector<CaseValues> materials_table(CaseRecord const& record);

/// The columns of the table `segregation` of a mixture: how the segregation index of each material changed
/// with time, one row for the end of each cycle 0 ... n.
std::vector<Entry> const& segregation_entries();
/// The values of its first columns: as many as the mixture has materials. None when the case is no mixture.
std::vector<CaseValues> segregation_table(CaseRecord const& record);

/// Fills in what the packings of a mixture have in their records beside their cycles, of which the start-up
/// is known.
void add_materials(CaseRecord& record);

/// The quantities of a mixture, of the first of [[materials]]; without one they have no value.
std::vector<Quantity> material_quantities();

}  // namespace vibrotrough::store
