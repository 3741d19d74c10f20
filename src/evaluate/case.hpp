#pragma once

#include "evaluate/packing.hpp"
#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

#include <string>
#include <vector>

namespace vibrotrough::evaluate {

/// The group of a packing: odd numbers start below the expected speed, even numbers above it.
measure::Start start_of(int packing);

/// What an estimate makes of a case: finished only when it is steady and its interval of statistics and
/// numerics together is as narrow as measure.half_width asks.
core::Outcome outcome_of(measure::CaseEstimate const& estimate, scenario::Scenario const& scenario);

/// The velocity efficiency of a case from the cycles of its packings. With stages it is the mean over the
/// time of all stages, relative to the omega r cos(beta) of [trough], with Student's interval over the
/// packings.
measure::CaseEstimate estimate_of(std::vector<measure::PackingValues> const& packings,
                                  scenario::Scenario const& scenario);

/// The precision wanted of the packings' statistics, see prepare::statistics_plan().
measure::Precision wanted_statistics(scenario::Scenario const& scenario);

/// What more a case would take that is not precise, or the branches of one that is bistable or slow: one line
/// for people, empty for other outcomes.
std::string remark_on(store::CaseRecord const& record);

/// The result of a case from its packings.
/// @param id        of the case
/// @param packings  at least one; those that the campaign's policy calls enough
store::CaseRecord evaluate_case(prepare::PreparedCase const& prepared, std::string const& id,
                                std::string const& engine_version, EvaluatedPackings packings);

}  // namespace vibrotrough::evaluate
