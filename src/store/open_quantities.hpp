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

/// kg/(s m), half-width of the mass flow per width of an open trough. A deep layer is often a slow one, so
/// that depth and speed do not scatter independently: it is that of Student's interval over the packings'
/// products of the two, and of what all packings share of the speed's error, a start-up and the numerics, as
/// the root of the sum of squares. Infinite with fewer than two packings; none where the flow is not known.
std::optional<double> open_flow_half_width(CaseRecord const& record);

/// The quantities of an open trough; other cases have no values.
std::vector<Quantity> open_quantities();

}  // namespace vibrotrough::store
