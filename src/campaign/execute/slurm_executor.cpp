#include "campaign/execute/slurm_executor.hpp"

#include "campaign/execute/slurm_batch.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/case_state.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <iterator>
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
        remove_remains_of_batches(inputs_.campaign_folder);
        std::vector<Batch> batches = read_batches(inputs_.campaign_folder);
        remember_lost_tasks(batches);
        return survey_tasks(batches);
    }

    std::string submit(std::vector<PackingOrder> const& orders) override {
        if (orders.empty()) return {};
        for (PackingOrder const& order : orders) {
            write_case_files(*order.planned);
            cases_[order.id()] = order.planned;
        }
        std::ranges::move(
            make_tasks(orders, {inputs_.task_duration, inputs_.speed, inputs_.settings.ranks.value_or(1)}),
            std::back_inserter(backlog_));
        if (most_ == 0) most_ = next_size_ = static_cast<std::size_t>(slurm::most_array_tasks());
        std::vector<long> const jobs = submit_backlog();
        return jobs.empty() ? std::string() : fmt::format("job {}", fmt::join(jobs, ", "));
    }

    std::size_t not_taken() const override {
        std::size_t packings = 0;
        for (Task const& task : backlog_) packings += task.size();
        return packings;
    }

    void adopt(PackingOrder const& order) override { held_[order.id()] = order.planned; }

    /// What Slurm has it keeps.
    void withdraw(PlannedCase const& planned) override {
        for (Task& task : backlog_)
            std::erase_if(task, [&](PackingId const& id) { return id.case_id == planned.id; });
        std::erase_if(backlog_, [](Task const& task) { return task.empty(); });
    }

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
        if (!backlog_.empty() && Clock::now() >= next_attempt_) submit_backlog();
        return ended;
    }

    bool is_idle() const override { return (held_.empty() && backlog_.empty()) || is_interrupted_; }
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

    /// Gives Slurm as many tasks as it takes now: arrays no longer than MaxArraySize allows, and shorter ones
    /// while it has no room for them.
    std::vector<long> submit_backlog() {
        std::vector<long> jobs;
        while (!backlog_.empty()) {
            std::size_t const size = std::min({next_size_, most_, backlog_.size()});
            std::vector<Task> const part(backlog_.begin(),
                                         backlog_.begin() + static_cast<std::ptrdiff_t>(size));
            if (auto const job = submit_array(part)) {
                jobs.push_back(*job);
                for (Task const& task : part) {
                    for (PackingId const& id : task) held_[id] = cases_.at(id);
                }
                backlog_.erase(backlog_.begin(), backlog_.begin() + static_cast<std::ptrdiff_t>(size));
                next_size_ = std::min(most_, 2 * next_size_);
            } else if (size > 1) {
                next_size_ = size / 2;
            } else {
                break;
            }
        }
        next_attempt_ = Clock::now() + 10s;
        return jobs;
    }

    /// @return none when Slurm has no room for so many tasks now
    std::optional<long> submit_array(std::vector<Task> const& tasks) {
        scenario::RunSettings const& settings = inputs_.settings;
        JobScript const script{inputs_.program,  settings.ranks.value_or(1),     time_limit(),
                               settings.retries, inputs_.foreign_commands.any(), settings.slurm.setup};
        Batch batch = write_batch(inputs_.campaign_folder, tasks, script);
        std::string const below = "slurm/" + batch.folder.filename().string();
        slurm::Array const array{
            inputs_.campaign_folder,        below + "/job.sh", below + "/task-%a.out", batch.name,
            static_cast<int>(tasks.size()), script.ranks,      of_largest(tasks)};
        std::optional<long> job;
        try {
            if (slurm::check(array)) job = slurm::submit(array);
        } catch (core::MissingError const&) {
            core::remove_tree(batch.folder);  // what Slurm refuses leaves nothing behind
            throw;
        }
        if (job) {
            remember_job(batch, *job);
        } else {
            core::remove_tree(batch.folder);
        }
        return job;
    }

    /// What is asked of Slurm: run.slurm.time is the time of one packing.
    scenario::SlurmSettings of_largest(std::vector<Task> const& tasks) const {
        scenario::SlurmSettings settings = inputs_.settings.slurm;
        std::size_t const most = std::ranges::max(tasks, {}, &Task::size).size();
        if (settings.minutes) *settings.minutes *= static_cast<int>(most);
        return settings;
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
    std::map<PackingId, PlannedCase const*> held_;   ///< submitted by this process, not seen to end
    std::map<PackingId, PlannedCase const*> cases_;  ///< of all packings that this process was given
    std::deque<Task> backlog_;                       ///< tasks for which Slurm had no room yet
    std::size_t most_ = 0;                           ///< tasks of an array; 0 before Slurm was asked
    std::size_t next_size_ = 0;                      ///< tasks of the next array, as far as there is room
    Clock::time_point next_survey_ = Clock::now();
    Clock::time_point next_attempt_ = Clock::now();  ///< to submit the backlog
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
