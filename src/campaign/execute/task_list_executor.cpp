#include "campaign/execute/task_list_executor.hpp"

#include "campaign/execute/case_files.hpp"
#include "campaign/execute/task_list.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/parallel.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

class TaskListExecutor : public Executor {
  public:
    explicit TaskListExecutor(ExecutorInputs const& inputs) : inputs_(inputs) {}

    /// Another scheduler cannot be asked; what a process works on now has a lock.
    std::vector<PackingActivity> given_before() override { return {}; }

    std::string submit(std::vector<PackingOrder> const& orders) override {
        std::vector<PlannedCase const*> cases;
        for (PackingOrder const& order : orders) cases.push_back(order.planned);
        write_case_files(std::move(cases));
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

    void adopt(PackingOrder const&) override {}
    void withdraw(PlannedCase const&) override {}
    std::vector<EndedPacking> wait() override { return {}; }
    bool is_idle() const override { return true; }
    void interrupt() override {}
    std::vector<RunningPacking> running() const override { return {}; }
    bool outlives_driver() const override { return true; }

  private:
    ExecutorInputs inputs_;
};

}  // namespace

std::unique_ptr<Executor> make_task_list_executor(ExecutorInputs const& inputs) {
    return std::make_unique<TaskListExecutor>(inputs);
}

}  // namespace vibrotrough::campaign
