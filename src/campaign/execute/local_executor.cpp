#include "campaign/execute/local_executor.hpp"

#include "campaign/execute/batch.hpp"
#include "campaign/execute/case_end.hpp"
#include "campaign/execute/outcome_reason.hpp"
#include "campaign/execute/packing_run.hpp"
#include "campaign/execute/ranks.hpp"
#include "campaign/outcome_names.hpp"
#include "campaign/schedule/time_to_go.hpp"
#include "campaign/state/case_state.hpp"
#include "campaign/state/folder_lock.hpp"
#include "campaign/state/result_index.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
#include <list>
#include <map>
#include <optional>

#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

struct Job {
    std::size_t case_index;
    int packing;
    auto operator<=>(Job const&) const = default;
};

/// A packing that runs.
struct Running {
    Job job{};
    int ranks = 1;
    long memory_kills = 0;  ///< of the machine, when it started
    bool late = false;      ///< its time was over
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::unique_ptr<PackingRun> run = {};

    double elapsed() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
};

/// Cycles that a packing will still take, from how wide its interval is now: the width falls as 1/sqrt(n).
double cycles_to_go(scenario::Scenario const& scenario, Running const& one) {
    int const done = one.run->cycles();
    double needed = 30;  // typical
    if (auto const& estimate = one.run->estimate()) {
        double const width = estimate->half_width / scenario.measure.half_width;
        needed = std::max<double>(measure::fewest_cycles, estimate->measured * width * width) +
                 estimate->discarded;
    }
    return std::clamp<double>(needed, done, std::max(done, scenario.measure.max_cycles)) - done;
}

class LocalExecutor {
  public:
    LocalExecutor(Plan const& plan, engine::Engine const& engine, scenario::RunSettings const& settings,
                  int jobs, Observer& observer)
        : plan_(plan), engine_(engine), settings_(settings), jobs_(jobs), observer_(observer) {}

    Summary run() {
        settled_.remove_leftovers();
        collect_jobs();
        // The longest first: what starts last should not last longest.
        std::ranges::stable_sort(queue_, std::ranges::greater(), [&](Job const& job) {
            return time_to_go_.work(plan_.cases[job.case_index].scenario, 1);
        });
        signals_.async_wait([this](auto const& cancelled, int) {
            if (!cancelled) interrupt();
        });
        start_jobs();
        tick();
        context_.run();
        index_.save();
        return summary();
    }

  private:
    void collect_jobs() {
        for (std::size_t i = 0; i < plan_.cases.size(); ++i) {
            PlannedCase const& planned = plan_.cases[i];
            if (auto const result = index_.find(planned)) {
                outcomes_[i] = result->outcome;
                for (auto const& packing : result->packings) progress_.core_time += packing.wall_time;
                continue;
            }
            ++progress_.left;
            if (auto const failure = read_failure(planned)) attempts_[i] = failure->attempts;
            for (int packing = 1; packing <= planned.scenario.measure.packings; ++packing) {
                ++progress_.packings;
                if (read_finished_packing(planned, packing)) {
                    ++progress_.packings_done;
                } else {
                    // What an interrupted run left would look like a run of today's, unless this goes on
                    // from its checkpoint.
                    fs::path const left = planned.packing_folder(packing);
                    if (case_state(planned) != CaseState::failed && !has_checkpoint(left))
                        fs::remove_all(left);
                    enqueue({i, packing});
                }
            }
            if (missing_[i] == 0) finish_or_run_again(i);
        }
        progress_.finished = static_cast<int>(outcomes_.size());
    }

    void enqueue(Job const& job) {
        queue_.push_back(job);
        time_to_go_.expect(plan_.cases[job.case_index].scenario);
        ++missing_[job.case_index];
    }

    /// All packings are marked as finished; if one is damaged all the same, all are run again.
    void finish_or_run_again(std::size_t index) {
        try {
            finish_case(index);
        } catch (core::Error const& damage) {
            int const packings = plan_.cases[index].scenario.measure.packings;
            progress_.packings_done -= packings;
            for (int packing = 1; packing <= packings; ++packing) enqueue({index, packing});
        }
    }

    void start_jobs() {
        while (!stopping_ && !queue_.empty()) {
            Job const job = queue_.front();
            int const ranks = ranks_of(job);
            if (!running_.empty() && busy_cores() + ranks > jobs_) break;
            queue_.pop_front();
            if (failures_.contains(job.case_index)) {
                time_to_go_.drop(plan_.cases[job.case_index].scenario);
                continue;
            }
            start(job, ranks);
        }
        if (running_.empty()) {
            done_ = true;
            signals_.cancel();
            clock_.cancel();
        }
    }

    int busy_cores() const {
        int cores = 0;
        for (Running const& one : running_) cores += one.ranks;
        return cores;
    }

    /// Several ranks only when there are fewer packings left than cores.
    int ranks_of(Job const& job) const {
        int const left = static_cast<int>(queue_.size() + running_.size());
        return choose_ranks(settings_, plan_.cases[job.case_index].scenario, std::max(1, jobs_ / left));
    }

    engine::Engine const& engine_with(int ranks) {
        auto& engine = engines_[ranks];
        engine = engine_;
        engine.ranks = ranks;
        return engine;
    }

    void start(Job const& job, int ranks) {
        PlannedCase const& planned = plan_.cases[job.case_index];
        write_case_files(planned);
        fs::remove(planned.failure_file());  // a failure.json means that the last try failed
        running_.push_back({job, ranks, count_memory_kills()});
        auto const place = std::prev(running_.end());
        try {
            place->run = std::make_unique<PackingRun>(
                context_, engine_with(ranks), settled_, planned, job.packing,
                [this, place](PackingOutcome const& outcome) { ended(place, outcome); });
        } catch (...) {
            running_.erase(place);
            throw;
        }
    }

    using Place = std::list<Running>::iterator;

    void ended(Place place, PackingOutcome outcome) {
        Job const job = place->job;
        int const cycles = place->run->cycles();
        progress_.core_time += place->elapsed() * place->ranks;
        if (place->late && outcome.outcome == "interrupted") outcome = too_late();
        outcome = find_reason(plan_.cases[job.case_index], job.packing, outcome, place->memory_kills);
        auto measured = outcome.well ? std::optional(place->run->take_measured()) : std::nullopt;
        // The run is in the middle of its own call: it is destroyed after it has returned.
        context_.post([run = std::shared_ptr<PackingRun>(std::move(place->run))] {});
        running_.erase(place);
        if (!outcome.well) check_engine();
        scenario::Scenario const& scenario = plan_.cases[job.case_index].scenario;
        if (outcome.well) {
            ++progress_.packings_done;
            time_to_go_.done(scenario, cycles);
            measured_[job.case_index].emplace(job.packing, std::move(*measured));
            if (--missing_[job.case_index] == 0) finish_case(job.case_index);
        } else if (retry_makes_sense(outcome.outcome) && tries_[job]++ < settings_.retries && !stopping_) {
            queue_.push_front(job);
        } else if (outcome.outcome != "interrupted") {
            time_to_go_.drop(scenario);
            fail_case(job, outcome);
        }
        report();
        start_jobs();
    }

    void finish_case(std::size_t index) {
        PlannedCase const& planned = plan_.cases[index];
        auto const known = measured_.extract(index);
        auto const result = campaign::finish_case(planned, plan_.engine_version,
                                                  known.empty() ? MeasuredPackings{} : known.mapped());
        if (!result) throw core::InputError(fmt::format("a packing of case {} is damaged", planned.id));
        index_.remember(planned, *result);
        outcomes_[index] = result->outcome;
        ++progress_.finished;
        --progress_.left;
        observer_.case_ended(planned, result->outcome, {});
    }

    PackingOutcome too_late() const {
        return {false, "time-limit",
                fmt::format("not finished after {:.0f} s", settings_.time_limit.value_or(0))};
    }

    /// Without its program no case can run: they have not failed.
    void check_engine() const {
        std::error_code ignored;
        if (fs::exists(engine_.program, ignored)) return;
        throw core::MissingError(
            fmt::format("the engine {} is gone; put it back, or name another with --liggghts PATH",
                        engine_.program.string()));
    }

    void fail_case(Job const& job, PackingOutcome const& outcome) {
        if (!failures_.insert({job.case_index, outcome.outcome}).second) return;
        PlannedCase const& planned = plan_.cases[job.case_index];
        measured_.erase(job.case_index);  // in its folder, for the next run
        write_failure(planned, {outcome.outcome, outcome.message, job.packing, ++attempts_[job.case_index]});
        ++progress_.failed;
        --progress_.left;
        observer_.case_ended(planned, outcome.outcome, outcome.message);
    }

    void interrupt() {
        stopping_ = true;
        interrupted_ = true;
        for (Running const& one : running_) one.run->interrupt();
        if (running_.empty()) clock_.cancel();
    }

    void tick() {
        if (done_) return;
        for (Running& one : running_) {
            one.run->look();
            if (one.late || !settings_.time_limit || one.elapsed() < *settings_.time_limit) continue;
            one.late = true;
            one.run->interrupt();
        }
        report();
        clock_.expires_after(250ms);
        clock_.async_wait([this](auto const& cancelled) {
            if (!cancelled) tick();
        });
    }

    void report() {
        progress_.running = static_cast<int>(running_.size());
        progress_.elapsed = time_to_go_.elapsed();
        double under_way = 0;
        double const ended_core_time = progress_.core_time;
        progress_.engines.clear();
        for (Running const& one : running_) {
            PlannedCase const& planned = plan_.cases[one.job.case_index];
            int const cycles = one.run->cycles();
            under_way += time_to_go_.work(planned.scenario, cycles);
            progress_.core_time += one.elapsed() * one.ranks;
            double const to_go =
                cycles > 0 ? one.elapsed() / cycles * cycles_to_go(planned.scenario, one) : -1;
            progress_.engines.push_back(
                {&planned, one.job.packing, cycles, one.run->estimate(), one.elapsed(), to_go});
        }
        progress_.time_to_go = time_to_go_.seconds(under_way);
        progress_.core_time_to_go = progress_.time_to_go < 0 ? -1 : progress_.time_to_go * busy_cores();
        observer_.progressed(progress_);
        progress_.core_time = ended_core_time;
    }

    Summary summary() const {
        Summary summary;
        for (auto const& [index, outcome] : outcomes_)
            ++(outcome == "finished" ? summary.finished : summary.unsure);
        summary.failed = static_cast<int>(failures_.size());
        summary.interrupted = interrupted_;
        return summary;
    }

    Plan const& plan_;
    engine::Engine const& engine_;
    scenario::RunSettings const& settings_;
    int jobs_;
    std::map<int, engine::Engine> engines_;  ///< by number of ranks
    Observer& observer_;
    boost::asio::io_context context_;
    boost::asio::signal_set signals_{context_, SIGINT, SIGTERM, SIGHUP};
    boost::asio::steady_timer clock_{context_};
    std::deque<Job> queue_;
    SettledPackings settled_{context_, engine_with(settings_.ranks.value_or(1)), plan_.folder};
    std::list<Running> running_;
    ResultIndex index_{plan_};
    std::map<std::size_t, MeasuredPackings> measured_;  ///< of cases that are not finished
    std::map<Job, int> tries_;                          ///< failed ones of this run, by packing
    std::map<std::size_t, int> missing_;                ///< packings that an unfinished case still needs
    std::map<std::size_t, std::string> outcomes_;       ///< of cases with a result
    std::map<std::size_t, std::string> failures_;       ///< of cases that failed in this run
    TimeToGo time_to_go_;
    Progress progress_;
    std::map<std::size_t, int> attempts_;  ///< failures so far, of this and of earlier runs
    bool done_ = false;
    bool stopping_ = false;
    bool interrupted_ = false;
};

/// Tasks that Slurm still has would work on the same packings.
void refuse_if_in_queue(Plan const& plan) {
    std::vector<Batch> batches = read_batches(plan.folder);
    int alive = 0;
    for (TaskStatus const& status : look_at_tasks(batches)) alive += status.state != TaskState::ended ? 1 : 0;
    if (alive == 0) return;
    throw core::MissingError(
        fmt::format("{} packings of the campaign in {} are still in Slurm's hands; wait for them or "
                    "cancel them with scancel, then run again",
                    alive, plan.folder.string()));
}

}  // namespace

Summary run_locally(Plan const& plan, std::filesystem::path const& campaign_file,
                    engine::Engine const& engine, scenario::RunSettings const& settings, int jobs,
                    Observer& observer) {
    core::make_folder(plan.folder);
    FolderLock const lock(plan.folder);
    freeze(plan, campaign_file, engine);
    refuse_if_in_queue(plan);
    return LocalExecutor(plan, engine, settings, jobs, observer).run();
}

}  // namespace vibrotrough::campaign
