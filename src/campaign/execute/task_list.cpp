#include "campaign/execute/task_list.hpp"

#include "campaign/execute/case_files.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/execute/ranks.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "deck/estimates.hpp"

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
    auto const tasks = read_task_list(task_list);
    if (tasks && index >= 0 && static_cast<std::size_t>(index) < tasks->size())
        return (*tasks)[static_cast<std::size_t>(index)];
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
    return deck::work_of(*order.planned->prepared, 1, cycles) / (size.speed * cores);
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

namespace {

class TaskListExecutor : public Executor {
  public:
    explicit TaskListExecutor(ExecutorInputs const& inputs) : inputs_(inputs) {}

    /// Another scheduler cannot be asked; what a process works on now has a lock.
    std::string submit(std::vector<PackingOrder> const& orders) override {
        std::vector<char> is_free(orders.size());
        core::for_each_index(orders.size(), cases_per_thread, [&] {
            return [&](std::size_t i) {
                is_free[i] = lock_packing(*orders[i].planned, orders[i].packing.number) ? 1 : 0;
            };
        });
        std::vector<PackingOrder> free;
        for (std::size_t i = 0; i < orders.size(); ++i)
            if (is_free[i] != 0) free.push_back(orders[i]);
        scenario::RunSettings const& settings = inputs_.settings;
        std::vector<Task> const tasks =
            make_tasks(free, {inputs_.task_duration, inputs_.speed, settings.ranks.value_or(1)});
        core::write_file_atomically(inputs_.task_list, write_task_list(tasks));
        std::size_t const busy = orders.size() - free.size();
        std::string text = fmt::format("{} task{} in {}", tasks.size(), tasks.size() == 1 ? "" : "s",
                                       inputs_.task_list.string());
        if (busy > 0)
            text += fmt::format(", without {} packing{} being simulated now", busy, busy == 1 ? "" : "s");
        return text;
    }

    bool outlives_driver() const override { return true; }

  private:
    ExecutorInputs inputs_;
};

}  // namespace

std::unique_ptr<Executor> make_task_list_executor(ExecutorInputs const& inputs) {
    return std::make_unique<TaskListExecutor>(inputs);
}

}  // namespace vibrotrough::campaign
