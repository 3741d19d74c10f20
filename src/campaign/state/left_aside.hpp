#pragma once

#include "campaign/state/overview.hpp"

#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// What lies in a campaign's folder and is not in its tables, which nobody would miss otherwise.
struct LeftAside {
    std::vector<PlannedCase const*> faulty = {};  ///< cases with files that cannot be used
    std::string first_fault = {};                 ///< why, of the first of them
    std::size_t other_cases = 0;                  ///< case folders that belong to no case of the plan
};

/// Looks for it. @param cases  what survey() found of the plan
LeftAside find_left_aside(Plan const& plan, std::vector<CaseOverview> const& cases);

/// One sentence without a full stop, such as "1 of 3 cases (4f...: its folder cannot be read ...)"; empty
/// when nothing is left aside.
std::string describe(LeftAside const& left, Plan const& plan);

}  // namespace vibrotrough::campaign
