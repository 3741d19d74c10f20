#pragma once

#include "campaign/state/overview.hpp"
#include "compare/comparison.hpp"

#include <vector>

namespace vibrotrough::app {

/// What is known of a campaign's cases, and each one's row beside the theory, in the same order.
struct ComparedCases {
    std::vector<campaign::CaseOverview> cases;
    std::vector<compare::Row> rows;
};

ComparedCases compared_cases(campaign::Plan const& plan);

}  // namespace vibrotrough::app
