#include "campaign/execute/slurm_executor.hpp"

#include "campaign/execute/slurm_batch.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/case_state.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::campaign {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

class SlurmExecutor : public Executor {
  public:
    explicit SlurmExecutor(ExecutorInputs const& inputs) : inputs_(inputs) {}

    std::vector<PackingActivity> given_before() override {
        std::vector<Batch> batches = read_batches(inputs_.campaign_folder);
        remember_lost_tasks(batches);
        return survey_tasks(batches);
    }

    std::string submit(std::vector<PackingOrder> const& orders) override {
        if (orders.empty()) return {};
        std::vector<long> jobs;
        auto const most = static_cast<std::size_t>(slurm::most_array_tasks());
        for (PackingOrder const& order : orders) write_case_files(*order.planned);
        std::vector<Task> const tasks =
            make_tasks(orders, {inputs_.task_duration, inputs_.speed, inputs_.settings.ranks.value_or(1)});
        for (std::size_t start = 0; start < tasks.size(); start += most) {
            std::size_t const end = std::min(start + most, tasks.size());
            std::vector<Task> const part(tasks.begin() + static_cast<std::ptrdiff_t>(start),
                                         tasks.begin() + static_cast<std::ptrdiff_t>(end));
            jobs.push_back(submit_array(part));
            remember(orders, part);
        }
        return fmt::format("job {}", fmt::join(jobs, ", "));
    }

    void adopt(PackingOrder const& order) override { held_[order.id()] = order.planned; }

    void withdraw(PlannedCase const&) override {}  // Slurm has them; a failed case does not stop the others

    std::vector<EndedPacking> wait() override {
        std::this_thread::sleep_for(250ms);
        std::vector<EndedPacking> ended;
        if (Clock::now() < next_survey_) return ended;
        std::vector<Batch> batches = read_batches(inputs_.campaign_folder);
        std::map<PackingId, PackingActivity> now;
        for (PackingActivity& one : survey_tasks(batches)) now.emplace(one.id, std::move(one));
        for (auto held = held_.begin(); held != held_.end();) {
            auto const found = now.find(held->first);
            bool const has_ended = found != now.end() && found->second.state == PackingActivity::ended;
            if (has_ended) ended.push_back(end_of(*held->second, found->second));
            held = has_ended ? held_.erase(held) : std::next(held);
        }
        next_survey_ = Clock::now() + 2s;
        return ended;
    }

    bool is_idle() const override { return held_.empty() || is_interrupted_; }
    void interrupt() override { is_interrupted_ = true; }
    std::vector<RunningPacking> running() const override { return {}; }
    bool outlives_driver() const override { return true; }

  private:
    /// What the task itself may use of Slurm's time, so that it can still write its exit marker.
    std::optional<double> time_limit() const {
        std::optional<double> limit = inputs_.settings.time_limit;
        if (inputs_.settings.slurm.minutes) {
            double const slurm = *inputs_.settings.slurm.minutes * 60.0;
            double const own = slurm - std::min(60.0, slurm / 4);
            limit = std::min(limit.value_or(own), own);
        }
        return limit;
    }

    long submit_array(std::vector<Task> const& tasks) {
        scenario::RunSettings const& settings = inputs_.settings;
        JobScript const script{inputs_.program, settings.ranks.value_or(1), time_limit(), settings.retries,
                               settings.slurm.setup};
        Batch batch = write_batch(inputs_.campaign_folder, tasks, script);
        std::string const below = "slurm/" + batch.folder.filename().string();
        slurm::Array const array{
            inputs_.campaign_folder,        below + "/job.sh", below + "/task-%a.out", batch.name,
            static_cast<int>(tasks.size()), script.ranks,      of_largest(tasks)};
        long job = 0;
        try {
            slurm::check(array);
            job = slurm::submit(array);
        } catch (core::MissingError const&) {
            core::remove_tree(batch.folder);  // what Slurm refuses leaves nothing behind
            throw;
        }
        remember_job(batch, job);
        return job;
    }

    /// What is asked of Slurm: run.slurm.time is the time of one packing.
    scenario::SlurmSettings of_largest(std::vector<Task> const& tasks) const {
        scenario::SlurmSettings settings = inputs_.settings.slurm;
        std::size_t const most = std::ranges::max(tasks, {}, &Task::size).size();
        if (settings.minutes) *settings.minutes *= static_cast<int>(most);
        return settings;
    }

    /// Holds the packings of tasks that were submitted.
    void remember(std::vector<PackingOrder> const& orders, std::vector<Task> const& tasks) {
        std::map<PackingId, PlannedCase const*> cases;
        for (PackingOrder const& order : orders) cases[order.id()] = order.planned;
        for (Task const& task : tasks) {
            for (PackingId const& id : task) held_[id] = cases.at(id);
        }
    }

    /// The packing's marker counts most, then the failure that the task recorded, then Slurm's report.
    static EndedPacking end_of(PlannedCase const& planned, PackingActivity const& activity) {
        EndedPacking ended{activity.id, {}, {}};
        if (evaluate::read_marker(planned.packing_folder(activity.id.packing))) return ended;
        auto const failure = read_failure(planned);
        ended.is_recorded = failure && failure->packing == activity.id.packing;
        ended.failure =
            ended.is_recorded ? failure->outcome : activity.outcome.value_or(core::Outcome::interrupted);
        ended.message = ended.is_recorded ? failure->message : activity.message;
        return ended;
    }

    ExecutorInputs inputs_;
    std::map<PackingId, PlannedCase const*> held_;  ///< submitted by this process, not seen to end
    Clock::time_point next_survey_ = Clock::now();
    bool is_interrupted_ = false;
};

}  // namespace

std::unique_ptr<Executor> make_slurm_executor(ExecutorInputs const& inputs) {
    return std::make_unique<SlurmExecutor>(inputs);
}

std::vector<PackingActivity> slurm_activity(std::filesystem::path const& campaign_folder) {
    std::vector<Batch> batches = read_batches(campaign_folder);
    return survey_tasks(batches);
}

}  // namespace vibrotrough::campaign
