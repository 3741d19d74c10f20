#pragma once

#include "evaluate/packing_files.hpp"
#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

#include <string>

namespace vibrotrough::evaluate {

/// Measures what came, stayed and went in a packing of an open trough. The cycles that count are those after
/// the start-up of the speed and after that of the hold-up, whichever is longer.
/// @throws core::InputError when a file is damaged
void measure_open(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                  PackingFiles const& files);

/// Why a case with an open trough is not steady: its outflow differs from the inflow by more than 2 % and the
/// interval of the difference over the packings (of one packing: 2 / sqrt(n) for n grains that were fed).
/// Empty when it is, and for other cases.
std::string unsteady_flow(store::CaseRecord const& record);

}  // namespace vibrotrough::evaluate
