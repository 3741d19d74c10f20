#pragma once

#include "campaign/schedule/policy.hpp"
#include "campaign/state/plan.hpp"
#include "campaign/state/result_summary.hpp"
#include "store/case_record.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace vibrotrough::campaign {

/// What the files say of a case before anything is run.
struct FoundCase {
    std::optional<FoundSummary> summary = {};  ///< of its result
    bool is_damaged = false;                   ///< there is a result that cannot be used
    KnownCase known = {};                      ///< of a case that may go on
    int attempts = 0;                          ///< failed ones of earlier runs
};

/// Whether more packings or cycles could still make a result precise or steady, if the policy wants them.
bool may_go_on(PlannedCase const& planned, store::CaseRecord const& record);

/// Looks at a case. A summary that is missing is written; a link in place of a packing is removed.
FoundCase look_at(PlannedCase const& planned);

/// The same for the cases of a plan from number `begin` on, some of them at the same time. They are `count`
/// at most: what is known of all cases at once would fill the memory twice.
std::vector<FoundCase> look_at(Plan const& plan, std::size_t begin, std::size_t count);

}  // namespace vibrotrough::campaign
