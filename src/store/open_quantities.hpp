#pragma once

#include "store/schema.hpp"

#include <optional>
#include <vector>

/// @file
/// What is known of open troughs: flows, hold-up, and how long grains stay.

namespace vibrotrough::store {

/// The tables of each packing of an open trough.
std::vector<PackingTable> open_tables();

/// The tables of the case: the layer along the trough, and how long grains stay.
std::vector<CaseTable> open_case_tables();

/// kg/m^2, mass of the layer per area of trough: of an open trough the mean over the packings in the window,
/// of other layers what follows from the number of grains. None of an open trough in which too few cycles
/// were kept, and of a screen.
std::optional<double> measured_mass_per_area(CaseRecord const& record);

/// The quantities of an open trough; other cases have no values.
std::vector<Quantity> open_quantities();

}  // namespace vibrotrough::store
