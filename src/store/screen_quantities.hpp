#pragma once

#include "store/schema.hpp"

#include <vector>

/// @file
/// What is known of screens: what passes, by size and time, beside a model of the probability to pass.

namespace vibrotrough::store {

/// The tables of each packing on a screen.
std::vector<PackingTable> screen_tables();

/// The tables of the case: what passes by size, by time, and by both.
std::vector<CaseTable> screen_case_tables();

/// The quantities of a screen; other cases have no values.
std::vector<Quantity> screen_quantities();

}  // namespace vibrotrough::store
