#pragma once

#include "campaign/state/overview.hpp"
#include "compare/columns.hpp"
#include "measure/case_estimate.hpp"

#include <optional>
#include <span>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace vibrotrough::compare {

/// The states of a campaign's cases and their rows beside the theory.
struct ComparedCases {
    std::vector<campaign::CaseOverview> cases;  ///< in the order of the plan
    std::vector<Row> rows;                      ///< of the same cases in the same order
    std::vector<Column> columns;                ///< of the rows, see columns_of()
    /// Of the velocity efficiencies, in the same order; none without a result.
    std::vector<std::optional<measure::CaseEstimate>> estimates = {};
    int outdated = 0;  ///< cases with observables of an earlier result, which no row has
};

/// The columns of a campaign: those of all, of its swept keys, and of its observables
/// (campaign::read_observables).
/// @throws core::InputError when observables.json is damaged
std::vector<Column> columns_of(campaign::Plan const& plan);

/// Compares all cases of a campaign with the theory. The friction of a layer is used where a friction test
/// has measured it, and the numerical error where a study has (campaign::read_case_numerics).
/// @param activity  what the executors know of the campaign, for cases without a result
/// @param sink      sees each case with its result, too
ComparedCases compared_cases(campaign::Plan const& plan, campaign::Activity const& activity,
                             campaign::OverviewSink const& sink = {});

/// The row of a case of a plan without result and theory: its drive and its swept keys.
Row planned_row(campaign::Plan const& plan, campaign::CaseOverview const& one);

/// The rows with all columns as a JSON array. Each object also has the members label (what distinguishes the
/// case), message, packings_done and packings_wanted from the state of the case.
nlohmann::ordered_json case_list(ComparedCases const& compared);

}  // namespace vibrotrough::compare
