#include "campaign/state/left_aside.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::campaign {

LeftAside find_left_aside(Plan const& plan, std::vector<CaseOverview> const& cases) {
    LeftAside left{{}, {}, count_left_aside(plan)};
    for (CaseOverview const& one : cases) {
        if (one.fault.empty()) continue;
        if (left.faulty.empty()) left.first_fault = one.fault;
        left.faulty.push_back(one.planned);
    }
    return left;
}

std::string describe(LeftAside const& left, Plan const& plan) {
    std::vector<std::string> parts;
    if (!left.faulty.empty()) {
        parts.push_back(fmt::format("{} of {} cases ({}{}: {})", left.faulty.size(), plan.cases.size(),
                                    left.faulty.size() == 1 ? "" : "the first is ", left.faulty.front()->id,
                                    left.first_fault));
    }
    if (left.other_cases > 0) {
        parts.push_back(fmt::format(
            "{} case folder{} that belong{} to no case of the campaign file, or to an older version of this "
            "program (before 0.3 ids were others)",
            left.other_cases, left.other_cases == 1 ? "" : "s", left.other_cases == 1 ? "s" : ""));
    }
    return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace vibrotrough::campaign
