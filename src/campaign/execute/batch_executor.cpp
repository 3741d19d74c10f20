#include "campaign/execute/batch.hpp"
#include "campaign/execute/executors.hpp"
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

class BatchExecutor : public Executor {
  public:
    explicit BatchExecutor(ExecutorInputs const& inputs) : inputs_(inputs) {}

    std::vector<PackingActivity> given_before() override { return survey_packings(inputs_.campaign_folder); }

    std::string submit(std::vector<PackingOrder> const& orders) override {
        if (orders.empty()) return {};
        for (PackingOrder const& order : orders) cases_[order.id()] = order.planned;
        std::ranges::move(make_tasks(orders, {inputs_.task_duration, inputs_.speed, ranks(), engines()}),
                          std::back_inserter(backlog_));
        std::vector<long> const jobs = submit_backlog();
        return jobs.empty() ? std::string() : fmt::format("job {}", fmt::join(jobs, ", "));
    }

    std::size_t not_taken() const override {
        std::size_t packings = 0;
        for (Task const& task : backlog_) packings += task.size();
        return packings;
    }

    void adopt(PackingOrder const& order) override { held_[order.id()] = order.planned; }

    void withdraw(PlannedCase const& planned) override {
        auto const is_of_case = [&](PackingId const& id) { return id.case_id == planned.id; };
        for (Task& task : backlog_) std::erase_if(task, is_of_case);
        std::erase_if(backlog_, [](Task const& task) { return task.empty(); });
        if (!std::ranges::any_of(held_, [&](auto const& held) { return is_of_case(held.first); })) return;
        std::vector<Batch> batches = read_batches(inputs_.campaign_folder);
        auto const activities = survey_tasks(batches);
        for (std::size_t i = 0; i < batches.size(); ++i) {
            std::vector<int> waiting;
            for (std::size_t k = 0; k < activities[i].size(); ++k) {
                Task const& task = batches[i].tasks[k];
                if (activities[i][k].state != PackingActivity::waiting) continue;
                if (!std::ranges::all_of(task, is_of_case)) continue;
                waiting.push_back(static_cast<int>(k));
                for (PackingId const& id : task) held_.erase(id);
            }
            if (!waiting.empty()) cancel_in_slurm({batches[i].name, batches[i].job}, waiting);
        }
    }

    std::vector<EndedPacking> wait() override {
        std::this_thread::sleep_for(250ms);
        std::vector<EndedPacking> ended;
        if (Clock::now() < next_survey_) return ended;
        std::map<PackingId, PackingActivity> now;
        for (PackingActivity& one : survey_packings(inputs_.campaign_folder))
            now.emplace(one.id, std::move(one));
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
    bool outlives_driver() const override { return true; }

  private:
    /// What the task itself may use of Slurm's time, so that it can still write its exit marker.
    std::optional<double> time_limit() const {
        std::optional<double> limit = inputs_.settings.time_limit;
        if (asked_.minutes && !is_warned()) {
            double const whole = *asked_.minutes * 60.0;
            double const own = whole - std::min(60.0, whole / 4);
            limit = std::min(limit.value_or(own), own);
        }
        return limit;
    }

    /// Gives Slurm as many tasks as it takes now: arrays no longer than the site allows, and shorter
    /// ones while there is no room for them.
    std::vector<long> submit_backlog() {
        std::vector<long> jobs;
        while (!backlog_.empty()) {
            std::size_t const size = std::min({next_size_, most_, backlog_.size()});
            std::vector<Task> const part(backlog_.begin(),
                                         backlog_.begin() + static_cast<std::ptrdiff_t>(size));
            Submission const made = submit_array(part);
            if (made.job) {
                jobs.push_back(*made.job);
                for (Task const& task : part) {
                    for (PackingId const& id : task) held_[id] = cases_.at(id);
                }
                backlog_.erase(backlog_.begin(), backlog_.begin() + static_cast<std::ptrdiff_t>(size));
                next_size_ = std::min(most_, 2 * next_size_);
            } else if (size > 1 && made.most_tasks) {
                most_ = next_size_ =
                    std::clamp<std::size_t>(static_cast<std::size_t>(*made.most_tasks), 1, size - 1);
            } else if (size > 1) {
                next_size_ = size / 2;
            } else {
                break;
            }
        }
        next_attempt_ = Clock::now() + 10s;
        return jobs;
    }

    Submission submit_array(std::vector<Task> const& tasks) {
        JobScript const script{inputs_.program,
                               ranks(),
                               time_limit(),
                               inputs_.settings.retries,
                               inputs_.foreign_commands.any(),
                               asked_.setup,
                               engines(),
                               is_warned(),
                               inputs_.is_learning};
        Batch batch = write_batch(inputs_.campaign_folder, tasks, script);
        JobArray const array{std::filesystem::absolute(inputs_.campaign_folder),
                             "slurm/" + batch.folder.filename().string(),
                             batch.name,
                             static_cast<int>(tasks.size()),
                             std::max(ranks(), asked_.cores_per_task.value_or(1)),
                             of_largest(tasks)};
        Submission made;
        try {
            made = submit_to_slurm(array);
        } catch (core::MissingError const&) {
            std::filesystem::remove_all(batch.folder);  // what is refused leaves nothing behind
            throw;
        }
        if (made.job) {
            remember_job(batch, *made.job);
        } else {
            std::filesystem::remove_all(batch.folder);
        }
        return made;
    }

    int ranks() const { return inputs_.settings.ranks.value_or(1); }

    /// Whether a task hears of its end before it comes, and can be queued again.
    bool is_warned() const {
        auto const has = [&](std::string_view start) {
            return std::ranges::any_of(asked_.extra, [&](scenario::BatchOption const& option) {
                return option.str().starts_with(start);
            });
        };
        return has("--requeue") && has("--signal=B:USR1@");
    }

    /// That a task runs at the same time.
    int engines() const { return std::max(1, asked_.cores_per_task.value_or(1) / ranks()); }

    /// What is asked of Slurm: the keys time and memory are those of one packing.
    scenario::BatchSettings of_largest(std::vector<Task> const& tasks) const {
        scenario::BatchSettings settings = asked_;
        int const most = static_cast<int>(std::ranges::max(tasks, {}, &Task::size).size());
        if (settings.minutes) *settings.minutes *= (most + engines() - 1) / engines();
        if (settings.memory) *settings.memory *= engines();
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

    static constexpr std::size_t largest_array = 100'000;

    ExecutorInputs inputs_;
    scenario::BatchSettings const& asked_ = inputs_.settings.slurm;
    std::map<PackingId, PlannedCase const*> held_;   ///< submitted by this process, not seen to end
    std::map<PackingId, PlannedCase const*> cases_;  ///< of all packings that this process was given
    std::deque<Task> backlog_;                       ///< tasks for which there was no room yet
    std::size_t most_ = largest_array;               ///< tasks of an array, as far as it is known
    std::size_t next_size_ = largest_array;          ///< tasks of the next array, as far as there is room
    Clock::time_point next_survey_ = Clock::now();
    Clock::time_point next_attempt_ = Clock::now();  ///< to submit the backlog
    bool is_interrupted_ = false;
};

}  // namespace

std::unique_ptr<Executor> make_batch_executor(ExecutorInputs const& inputs) {
    return std::make_unique<BatchExecutor>(inputs);
}

}  // namespace vibrotrough::campaign
