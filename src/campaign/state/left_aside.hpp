#pragma once

#include "campaign/state/overview.hpp"

#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// What lies in a campaign's folder and is not in its tables, which nobody would miss otherwise: one sentence
/// without a full stop, such as "1 of 3 cases (4f...: its folder cannot be read ...)"; empty when there is
/// nothing. @param cases  what survey() found of the plan
std::string describe_left_aside(Plan const& plan, std::vector<CaseOverview> const& cases);

}  // namespace vibrotrough::campaign
