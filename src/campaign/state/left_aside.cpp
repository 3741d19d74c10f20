#include "campaign/state/left_aside.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::campaign {

std::string describe_left_aside(Plan const& plan, std::vector<CaseOverview> const& cases) {
    std::vector<std::string> parts;
    auto const has_fault = [](CaseOverview const& one) { return !one.fault.empty(); };
    if (auto const first = std::ranges::find_if(cases, has_fault); first != cases.end()) {
        auto const count = std::ranges::count_if(cases, has_fault);
        parts.push_back(fmt::format("{} of {} cases ({}{}: {})", count, plan.cases.size(),
                                    count == 1 ? "" : "the first is ", first->planned->id, first->fault));
    }
    if (std::size_t const others = count_left_aside(plan); others > 0) {
        parts.push_back(fmt::format(
            "{} case folder{} that belong{} to no case of the campaign file, or to an older version of this "
            "program (before 0.3 ids were others)",
            others, others == 1 ? "" : "s", others == 1 ? "s" : ""));
    }
    return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace vibrotrough::campaign
