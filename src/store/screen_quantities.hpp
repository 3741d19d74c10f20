#pragma once

#include "store/material_quantities.hpp"
#include "store/quantity.hpp"
#include "store/schema.hpp"

#include <vector>

/// @file
/// What is known of screens: what passes, by size and time, beside a model of the probability to pass.

namespace vibrotrough::store {

/// The columns of the table `sizes` of each packing on a screen.
std::vector<PackingTable> const& size_tables();

/// Those of `screen` and `passed`, of a batch on a screen.
std::vector<PackingTable> const& batch_tables();

/// Those of `through` and `size_cycles`, of a screen with a feed.
std::vector<PackingTable> const& fed_screen_tables();

/// The columns of the table `partition`: one row for each size, from the smallest.
std::vector<Entry> const& partition_entries();
/// Their values; none without a screen.
std::vector<CaseValues> partition_table(CaseRecord const& record);

/// The columns of the table `screening`: one row for the end of each cycle 0 ... n.
std::vector<Entry> const& screening_entries();
/// Their values; none without a screen.
std::vector<CaseValues> screening_table(CaseRecord const& record);

/// The columns of the table `partition_cycles`: one row for each size and the end of each cycle 0 ... n.
std::vector<Entry> const& partition_cycles_entries();
/// Their values; none without a screen.
std::vector<CaseValues> partition_cycles_table(CaseRecord const& record);

/// The quantities of a screen; other cases have no values.
std::vector<Quantity> screen_quantities();

}  // namespace vibrotrough::store
