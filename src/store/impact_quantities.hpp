#pragma once

#include "store/material_quantities.hpp"
#include "store/quantity.hpp"
#include "store/schema.hpp"

#include <vector>

/// @file
/// What is known of the energies of impacts.

namespace vibrotrough::store {

/// The columns of the table `impacts/<packing>`: one row for each class of energy.
std::vector<PackingTable> const& impact_tables();

/// The columns of the table `impact_spectrum` of a case: one row for each class of energy.
std::vector<Entry> const& impact_spectrum_entries();
/// Their values; none without measure.impacts.
std::vector<CaseValues> impact_spectrum_table(CaseRecord const& record);

/// The quantities of the impacts; without measure.impacts they have no value.
std::vector<Quantity> impact_quantities();

}  // namespace vibrotrough::store
