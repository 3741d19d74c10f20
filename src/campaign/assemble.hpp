#pragma once

#include "campaign/measured_packing.hpp"
#include "campaign/state/plan.hpp"
#include "store/case_record.hpp"

namespace vibrotrough::campaign {

/// Puts the result of a case together from its finished packings.
/// @param known  packings that were measured already; the others are read from their folders
/// @throws InputError when one is not finished or its files are damaged
store::CaseRecord assemble(PlannedCase const& planned, std::string const& engine_version,
                           MeasuredPackings known = {});

}  // namespace vibrotrough::campaign
