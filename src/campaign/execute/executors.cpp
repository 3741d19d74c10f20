#include "campaign/execute/executors.hpp"

#include "campaign/execute/batch_executor.hpp"
#include "campaign/execute/local_executor.hpp"
#include "campaign/execute/task_list_executor.hpp"
#include "campaign/state/folder_lock.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

std::vector<PackingActivity> none(std::filesystem::path const&) {
    return {};
}

/// Tasks of job arrays.
template <Scheduler const& scheduler>
ExecutorKind batch_kind() {
    return {scheduler.name, scheduler.title,
            [](ExecutorInputs const& inputs) { return make_batch_executor(scheduler, inputs); },
            [](std::filesystem::path const& folder) { return batch_activity(scheduler, folder); },
            [](std::filesystem::path const& folder) { return batch_core_time(scheduler, folder); }};
}

std::array const kinds{
    ExecutorKind{"local", "this machine", make_local_executor, none},
    batch_kind<slurm>(),
    // Not of campaign files: `vibrotrough prepare` uses it.
    ExecutorKind{"task-list", "a task list", make_task_list_executor, none},
};

bool is_alive(PackingActivity const& activity) {
    return activity.state != PackingActivity::ended;
}

}  // namespace

std::span<ExecutorKind const> executor_kinds() {
    return kinds;
}

ExecutorKind const& executor_kind(std::string_view name) {
    auto const found = std::ranges::find(kinds, name, &ExecutorKind::name);
    if (found == kinds.end()) throw std::out_of_range(fmt::format("there is no executor '{}'", name));
    return *found;
}

Activity activity_in(std::filesystem::path const& campaign_folder) {
    Activity activity{FolderLock::is_held(campaign_folder), {}};
    for (ExecutorKind const& kind : kinds) {
        for (PackingActivity& one : kind.activity(campaign_folder)) {
            // A driver at work knows itself what became of packings that ended.
            if (is_alive(one) || !activity.has_driver) activity.packings.push_back(std::move(one));
        }
    }
    return activity;
}

void refuse_other_executors(std::filesystem::path const& campaign_folder, ExecutorKind const& wanted) {
    for (ExecutorKind const& kind : kinds) {
        if (kind.name == wanted.name) continue;
        auto const alive = std::ranges::count_if(kind.activity(campaign_folder), is_alive);
        if (alive == 0) continue;
        throw core::MissingError(
            fmt::format("{} packings of the campaign in {} still wait or run in {}; wait for them or cancel "
                        "them there, then run again",
                        alive, campaign_folder.string(), kind.title));
    }
}

}  // namespace vibrotrough::campaign
