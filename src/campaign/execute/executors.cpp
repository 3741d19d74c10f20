#include "campaign/execute/executors.hpp"

#include "campaign/execute/batch.hpp"
#include "campaign/state/file_lock.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

constexpr std::array kinds{ExecutorKind{"local", make_local_executor},
                           ExecutorKind{"slurm", make_batch_executor},
                           // Not of campaign files: `vibrotrough prepare` uses it.
                           ExecutorKind{"task-list", make_task_list_executor}};

bool is_alive(PackingActivity const& activity) {
    return activity.state != PackingActivity::ended;
}

}  // namespace

ExecutorKind const& executor_kind(std::string_view name) {
    auto const found = std::ranges::find(kinds, name, &ExecutorKind::name);
    if (found == kinds.end()) throw std::out_of_range(fmt::format("there is no executor '{}'", name));
    return *found;
}

Activity activity_in(std::filesystem::path const& campaign_folder) {
    Activity activity{has_driver(campaign_folder), survey_packings(campaign_folder)};
    // A driver at work knows itself what became of packings that ended.
    if (activity.has_driver) std::erase_if(activity.packings, std::not_fn(is_alive));
    return activity;
}

void refuse_other_executors(std::filesystem::path const& campaign_folder, ExecutorKind const& wanted) {
    if (wanted.name == "slurm") return;
    auto const alive = std::ranges::count_if(survey_packings(campaign_folder), is_alive);
    if (alive == 0) return;
    throw core::MissingError(
        fmt::format("{} packings of the campaign in {} still wait or run in Slurm; wait for them or cancel "
                    "them there, then run again",
                    alive, campaign_folder.string()));
}

}  // namespace vibrotrough::campaign
