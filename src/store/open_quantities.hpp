#pragma once

#include "store/material_quantities.hpp"
#include "store/quantity.hpp"
#include "store/schema.hpp"

#include <optional>
#include <vector>

/// @file
/// What is known of open troughs: flows, hold-up, and how long grains stay.

namespace vibrotrough::store {

/// The columns of the tables of each packing of an open trough: `flow`, `along` and `residence`.
/// @param mesh  whether the trough has a mesh, to which a level along it belongs
std::vector<PackingTable> const& open_tables(bool mesh);

/// The columns of the table `along_trough`: one row for each bin along the trough.
std::vector<Entry> const& along_trough_entries();
/// Their values; none unless the trough is open and a packing has cycles that count.
std::vector<CaseValues> along_trough_table(CaseRecord const& record);

/// The columns of the table `residence_times`: one row for 0, 1 ... 100 % of the grains that left.
std::vector<Entry> const& residence_times_entries();
/// Their values; none unless the trough is open and enough grains left it in a packing.
std::vector<CaseValues> residence_times_table(CaseRecord const& record);

/// kg/m^2, mass of the layer per area of trough: of an open trough the mean over the packings in the window,
/// of other layers what follows from the number of grains. None of an open trough in which too few cycles
/// were kept, and of a screen.
std::optional<double> measured_mass_per_area(CaseRecord const& record);

/// The quantities of an open trough; other cases have no values.
std::vector<Quantity> open_quantities();

}  // namespace vibrotrough::store
