#include "campaign/execute/task_list.hpp"

#include "campaign/execute/ranks.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

/// Nothing when the line is damaged.
std::optional<Task> parse_task(std::string const& line) {
    std::istringstream text(line);
    Task task;
    for (PackingId id; text >> id.case_id;) {
        bool const is_read = static_cast<bool>(text >> id.packing);
        if (!is_read || !is_case_id(id.case_id) || id.packing < 1 || id.packing > 1000) return {};
        task.push_back(id);
    }
    if (task.empty() || task.size() > most_packings_per_task) return {};
    return task;
}

}  // namespace

Task read_task(fs::path const& task_list, int index) {
    std::istringstream lines(core::read_file(task_list, core::largest_note));
    std::string line;
    for (int i = 0; i <= index && std::getline(lines, line); ++i) {
        if (i < index) continue;
        if (auto const task = parse_task(line)) return *task;
    }
    throw core::InputError(
        fmt::format("{} has no task with index {}; give a list that 'vibrotrough run' or "
                    "'vibrotrough prepare' made",
                    task_list.string(), index));
}

std::optional<std::vector<Task>> read_task_list(fs::path const& task_list) {
    std::vector<Task> tasks;
    std::istringstream lines(core::read_file(task_list, core::largest_note));
    for (std::string line; std::getline(lines, line);) {
        auto task = parse_task(line);
        if (!task) return {};
        tasks.push_back(std::move(*task));
    }
    return tasks;
}

std::string write_task_list(std::vector<Task> const& tasks) {
    std::string list;
    for (Task const& task : tasks) {
        char const* gap = "";
        for (PackingId const& id : task)
            list += fmt::format("{}{} {}", std::exchange(gap, " "), id.case_id, id.packing);
        list += "\n";
    }
    return list;
}

double expected_time(PackingOrder const& order, TaskSize const& size) {
    auto const& scenario = order.planned->scenario();
    int const cycles = order.packing.cycles > 0 ? order.packing.cycles : scenario.measure.max_cycles;
    double const share = static_cast<double>(scenario.layer.grains) / size.ranks;
    // Where nothing was measured, several ranks are not counted upon.
    double const cores = size.ranks > 1 ? std::max(1.0, size.ranks * parallel_efficiency(share)) : 1.0;
    return order.planned->prepared->work(cycles) / (size.speed * cores);
}

std::vector<Task> make_tasks(std::vector<PackingOrder> const& orders, TaskSize const& size) {
    std::vector<Task> tasks;
    double filled = 0;
    for (PackingOrder const& order : orders) {
        double const time = expected_time(order, size);
        bool const has_idle_core =
            !tasks.empty() && tasks.back().size() < static_cast<std::size_t>(size.engines);
        bool const has_time =
            !tasks.empty() && size.duration && filled + time <= *size.duration * size.engines;
        bool const fits = (has_idle_core || has_time) && tasks.back().size() < most_packings_per_task;
        if (!fits) {
            tasks.emplace_back();
            filled = 0;
        }
        tasks.back().push_back(order.id());
        filled += time;
    }
    return tasks;
}

}  // namespace vibrotrough::campaign
