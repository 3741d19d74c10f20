#include "campaign/execute/found_case.hpp"

#include "campaign/state/case_state.hpp"
#include "core/parallel.hpp"

#include <algorithm>
#include <filesystem>

namespace vibrotrough::campaign {

namespace fs = std::filesystem;

bool may_go_on(PlannedCase const& planned, store::CaseRecord const& record) {
    return record.outcome != core::Outcome::finished && planned.scenario().measure.max_packings > 1;
}

FoundCase look_at(PlannedCase const& planned) {
    FoundCase found{find_summary(planned)};
    if (found.summary && found.summary->is_from_result) write_summary(planned, found.summary->record);
    if (found.summary && !may_go_on(planned, found.summary->record)) return found;
    std::error_code missing;
    found.is_damaged = !found.summary && fs::exists(planned.result_file(), missing);
    found.known = know(planned);
    if (auto const failure = read_failure(planned)) found.attempts = failure->attempts;
    return found;
}

std::vector<FoundCase> look_at(Plan const& plan, std::size_t begin, std::size_t count) {
    std::vector<FoundCase> found(std::min(count, plan.cases.size() - begin));
    core::for_each_index(found.size(), cases_per_thread,
                         [&] { return [&](std::size_t i) { found[i] = look_at(plan.cases[begin + i]); }; });
    return found;
}

}  // namespace vibrotrough::campaign
