#pragma once

#include "store/quantity.hpp"
#include "store/schema.hpp"

#include <vector>

/// @file
/// The wear of the trough, which measure.wear asks for.

namespace vibrotrough::store {

/// The columns of the table `wear` of a packing, which only a case with measure.wear has.
std::vector<PackingTable> const& wear_tables();

/// The quantities of the wear; other cases have no values.
std::vector<Quantity> wear_quantities();

}  // namespace vibrotrough::store
