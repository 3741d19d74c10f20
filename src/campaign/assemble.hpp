#pragma once

#include "campaign/plan.hpp"
#include "measure/estimate.hpp"
#include "store/case_record.hpp"

namespace vibrotrough::campaign {

/// The velocity efficiency of a series, measured as the scenario asks.
measure::SequentialEstimate estimate_series(Scenario const& scenario, measure::CycleSeries const& series);

/// Whether the mean is known as well as the scenario asks, so that the run may end.
bool enough_cycles(Scenario const& scenario, measure::CycleSeries const& series);

/// Puts the result of a case together from its finished packings.
/// @throws InputError when a packing's files are damaged
store::CaseRecord assemble(PlannedCase const& planned, std::string const& engine_version);

}  // namespace vibrotrough::campaign
