#pragma once

#include "evaluate/packing_files.hpp"
#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

namespace vibrotrough::evaluate {

/// Reads the wear of the trough at the end of each cycle into the record. Does nothing when measure.wear does
/// not ask for it.
/// @throws core::InputError when a snapshot of the wear is missing or damaged
void read_wear(store::PackingRecord& record, prepare::PreparedCase const& prepared,
               PackingFiles const& files);

/// Finds the rates of the wear over the cycles that the record counts, those of the case; of an open trough
/// over those in which it is full, too.
void measure_wear(store::PackingRecord& record, prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::evaluate
