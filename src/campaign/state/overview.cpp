#include "campaign/state/overview.hpp"

#include "campaign/execute/batch.hpp"
#include "campaign/execute/case_end.hpp"
#include "campaign/state/case_state.hpp"
#include "campaign/state/folder_lock.hpp"
#include "campaign/state/result_index.hpp"
#include "core/error.hpp"
#include "store/result_file.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::campaign {

namespace {

/// Whether a packing of the case is being simulated: a living driver, and a folder without its marker.
bool is_running(PlannedCase const& planned, bool driven) {
    if (!driven) return false;
    for (int packing = 1; packing <= planned.scenario.measure.packings; ++packing) {
        if (std::filesystem::is_directory(planned.packing_folder(packing)) &&
            !read_finished_packing(planned, packing)) {
            return true;
        }
    }
    return false;
}

/// Where the tasks of a campaign stand in Slurm, by case.
using CaseTasks = std::map<std::string, std::vector<TaskStatus>>;

CaseTasks look_at_slurm(Plan const& plan) {
    CaseTasks tasks;
    std::vector<Batch> batches = read_batches(plan.folder);
    for (TaskStatus& status : look_at_tasks(batches)) tasks[status.task.case_id].push_back(std::move(status));
    return tasks;
}

/// What Slurm adds to a case that has no result: it runs or waits, or its task died. A failure.json of the
/// task itself says more than Slurm does.
void add_slurm(CaseOverview& overview, std::vector<TaskStatus> const& tasks) {
    auto const find = [&](TaskState state) {
        return std::ranges::find_if(tasks, [&](TaskStatus const& status) {
            return status.state == state && !read_finished_packing(*overview.planned, status.task.packing);
        });
    };
    constexpr std::array<std::pair<TaskState, char const*>, 3> alive{
        {{TaskState::running, "running"}, {TaskState::waiting, "queued"}, {TaskState::unknown, "unknown"}}};
    for (auto const& [state, name] : alive) {
        auto const found = find(state);
        if (found == tasks.end()) continue;
        overview.outcome = name;
        overview.message = state == TaskState::running ? "" : found->message;
        return;
    }
    auto const died = find(TaskState::ended);
    if (died == tasks.end() || std::filesystem::is_regular_file(overview.planned->failure_file())) return;
    overview.outcome = died->outcome;
    overview.message = fmt::format("packing {}: {}", died->task.packing, died->message);
}

/// The last task of a case may have died between its packing's marker and the result.
void finish_for_slurm(PlannedCase const& planned, std::string const& engine_version) {
    try {
        finish_case(planned, engine_version);
    } catch (core::Error const&) {
        // A damaged packing, or a folder that only may be looked at: `run` mends it.
    }
}

CaseOverview look_at(ResultIndex& index, PlannedCase const& planned, bool driven) {
    CaseOverview overview{&planned, "open", {}, 0, index.find(planned)};
    if (overview.record) {
        overview.outcome = overview.record->outcome;
        overview.packings_done = planned.scenario.measure.packings;
        return overview;
    }
    overview.packings_done = count_finished_packings(planned);
    switch (case_state(planned)) {
        case CaseState::failed: {
            auto const failure = read_failure(planned);
            overview.outcome = failure ? failure->outcome : "failed";
            overview.message = failure ? failure->message : "failure.json is damaged";
            break;
        }
        case CaseState::started:
            overview.outcome = is_running(planned, driven) ? "running" : driven ? "open" : "interrupted";
            if (std::filesystem::exists(planned.result_file()))
                overview.message = "result.h5 is damaged; run again";
            break;
        case CaseState::open:
        case CaseState::finished:
            break;
    }
    return overview;
}

/// No driver is there to do it at the end of a campaign in Slurm.
void refresh_campaign_file(Plan const& plan, std::vector<CaseOverview> const& cases) {
    std::vector<store::CaseRecord> records;
    for (CaseOverview const& one : cases) {
        if (one.record) records.push_back(*one.record);
    }
    try {
        store::write_campaign(plan.folder / "campaign.h5", plan.name, records);
    } catch (core::MissingError const&) {
        // A folder that only may be looked at.
    }
}

}  // namespace

std::vector<CaseOverview> look_at(Plan const& plan) {
    bool const driven = FolderLock::is_held(plan.folder);
    CaseTasks const tasks = look_at_slurm(plan);
    ResultIndex index(plan);
    std::vector<CaseOverview> cases;
    cases.reserve(plan.cases.size());
    for (PlannedCase const& planned : plan.cases) {
        auto const found = tasks.find(planned.id);
        // A driver at work puts its results together itself.
        bool const in_slurm = found != tasks.end() && !driven;
        if (in_slurm && !std::filesystem::exists(planned.result_file()))
            finish_for_slurm(planned, plan.engine_version);
        cases.push_back(look_at(index, planned, driven));
        if (in_slurm && !cases.back().record) add_slurm(cases.back(), found->second);
    }
    bool const is_news = index.has_changed() && !tasks.empty() && !driven;
    index.save();
    if (is_news) refresh_campaign_file(plan, cases);
    return cases;
}

std::size_t count_left_aside(Plan const& plan) {
    std::set<std::string> ids;
    for (PlannedCase const& planned : plan.cases) ids.insert(planned.id);
    std::size_t count = 0;
    std::error_code ignored;
    for (auto const& entry : std::filesystem::directory_iterator(plan.folder / "cases", ignored)) {
        if (!ids.contains(entry.path().filename().string())) ++count;
    }
    return count;
}

void write_campaign_file(Plan const& plan) {
    ResultIndex index(plan);
    std::vector<store::CaseRecord> records;
    for (PlannedCase const& planned : plan.cases) {
        if (auto record = index.find(planned)) records.push_back(std::move(*record));
    }
    index.save();
    store::write_campaign(plan.folder / "campaign.h5", plan.name, records);
}

}  // namespace vibrotrough::campaign
