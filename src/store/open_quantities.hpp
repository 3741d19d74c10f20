#pragma once

#include "store/quantity.hpp"
#include "store/schema.hpp"

#include <optional>
#include <vector>

/// @file
/// What is known of open troughs: flows, hold-up, and how long grains stay.

namespace vibrotrough::store {

/// The columns of the tables of each packing of an open trough: `flow`, `along` and `residence`.
std::vector<PackingTable> const& open_tables();

/// kg/m^2, mass of the layer per area of trough: of an open trough the mean over the packings in the window,
/// of other layers what follows from the number of grains. None of an open trough in which too few cycles
/// were kept, and of a screen.
std::optional<double> measured_mass_per_area(CaseRecord const& record);

/// The quantities of an open trough; other cases have no values.
std::vector<Quantity> open_quantities();

}  // namespace vibrotrough::store
