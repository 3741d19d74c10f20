#pragma once

#include "campaign/state/overview.hpp"
#include "compare/columns.hpp"

#include <span>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace vibrotrough::compare {

/// What is known of a campaign's cases, and each one's row beside the theory, in the same order.
struct ComparedCases {
    std::vector<campaign::CaseOverview> cases;
    std::vector<Row> rows;
};

/// @param activity  what executors know of the campaign, for cases without a result
ComparedCases compared_cases(campaign::Plan const& plan, campaign::Activity const& activity);

/// The rows with all columns, each with what the state of the case adds: message, packings_done and
/// packings_wanted.
nlohmann::ordered_json case_list(ComparedCases const& compared,
                                 std::span<Column const> columns = all_columns());

}  // namespace vibrotrough::compare
