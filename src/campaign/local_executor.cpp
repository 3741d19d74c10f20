#include "campaign/local_executor.hpp"

#include "campaign/assemble.hpp"
#include "campaign/case_state.hpp"
#include "campaign/folder_lock.hpp"
#include "campaign/packing_run.hpp"
#include "campaign/time_to_go.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "store/result_file.hpp"

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
};

class LocalExecutor {
  public:
    LocalExecutor(Plan const& plan, engine::Engine const& engine, int jobs, Observer& observer)
        : plan_(plan), engine_(engine), jobs_(jobs), observer_(observer) {}

    Summary run() {
        settled_.remove_leftovers();
        collect_jobs();
        signals_.async_wait([this](auto const& cancelled, int) {
            if (!cancelled) interrupt();
        });
        start_jobs();
        tick();
        context_.run();
        return summary();
    }

  private:
    void collect_jobs() {
        for (std::size_t i = 0; i < plan_.cases.size(); ++i) {
            PlannedCase const& planned = plan_.cases[i];
            if (auto const result = read_whole_result(planned)) {
                outcomes_[i] = result->outcome;
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
        } catch (Error const& damage) {
            int const packings = plan_.cases[index].scenario.measure.packings;
            progress_.packings_done -= packings;
            for (int packing = 1; packing <= packings; ++packing) enqueue({index, packing});
        }
    }

    void start_jobs() {
        while (!stopping_ && static_cast<int>(running_.size()) < jobs_ && !queue_.empty()) {
            Job const job = queue_.front();
            queue_.pop_front();
            if (failures_.contains(job.case_index)) {
                time_to_go_.drop(plan_.cases[job.case_index].scenario);
                continue;
            }
            start(job);
        }
        if (running_.empty()) {
            done_ = true;
            signals_.cancel();
            clock_.cancel();
        }
    }

    void start(Job const& job) {
        PlannedCase const& planned = plan_.cases[job.case_index];
        write_case_files(planned);
        fs::remove(planned.failure_file());  // a failure.json means that the last try failed
        running_.emplace_back();
        auto const place = std::prev(running_.end());
        try {
            *place = std::make_unique<PackingRun>(
                context_, engine_, settled_, planned, job.packing,
                [this, job, place](PackingOutcome const& outcome) { ended(job, place, outcome); });
        } catch (...) {
            running_.erase(place);
            throw;
        }
    }

    using Place = std::list<std::unique_ptr<PackingRun>>::iterator;

    void ended(Job job, Place place, PackingOutcome outcome) {
        int const cycles = (*place)->cycles();
        // The run is in the middle of its own call: it is destroyed after it has returned.
        context_.post([run = std::shared_ptr<PackingRun>(std::move(*place))] {});
        running_.erase(place);
        Scenario const& scenario = plan_.cases[job.case_index].scenario;
        if (outcome.well) {
            ++progress_.packings_done;
            time_to_go_.done(scenario, cycles);
            if (--missing_[job.case_index] == 0) finish_case(job.case_index);
        } else if (outcome.outcome != "interrupted") {
            time_to_go_.drop(scenario);
            fail_case(job, outcome);
        }
        report();
        start_jobs();
    }

    void finish_case(std::size_t index) {
        PlannedCase const& planned = plan_.cases[index];
        store::CaseRecord const record = assemble(planned, plan_.engine_version);
        store::write_result(planned.result_file(), record);
        fs::remove(planned.failure_file());
        outcomes_[index] = record.outcome;
        ++progress_.finished;
        --progress_.left;
        observer_.case_ended(planned, record.outcome, {});
    }

    void fail_case(Job const& job, PackingOutcome const& outcome) {
        if (!failures_.insert({job.case_index, outcome.outcome}).second) return;
        PlannedCase const& planned = plan_.cases[job.case_index];
        write_failure(planned, {outcome.outcome, outcome.message, job.packing, ++attempts_[job.case_index]});
        ++progress_.failed;
        --progress_.left;
        observer_.case_ended(planned, outcome.outcome, outcome.message);
    }

    void interrupt() {
        stopping_ = true;
        interrupted_ = true;
        for (auto const& run : running_) run->interrupt();
        if (running_.empty()) clock_.cancel();
    }

    void tick() {
        if (done_) return;
        for (auto const& run : running_) run->look();
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
        for (auto const& run : running_)
            under_way += time_to_go_.work(run->planned().scenario, run->cycles());
        progress_.time_to_go = time_to_go_.seconds(under_way);
        observer_.progressed(progress_);
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
    int jobs_;
    Observer& observer_;
    boost::asio::io_context context_;
    boost::asio::signal_set signals_{context_, SIGINT, SIGTERM, SIGHUP};
    boost::asio::steady_timer clock_{context_};
    std::deque<Job> queue_;
    SettledPackings settled_{context_, engine_, plan_.folder};
    std::list<std::unique_ptr<PackingRun>> running_;
    std::map<std::size_t, int> missing_;           ///< packings that an unfinished case still needs
    std::map<std::size_t, std::string> outcomes_;  ///< of cases with a result
    std::map<std::size_t, std::string> failures_;  ///< of cases that failed in this run
    TimeToGo time_to_go_;
    Progress progress_;
    std::map<std::size_t, int> attempts_;  ///< failures so far, of this and of earlier runs
    bool done_ = false;
    bool stopping_ = false;
    bool interrupted_ = false;
};

}  // namespace

Summary run_locally(Plan const& plan, std::filesystem::path const& campaign_file,
                    engine::Engine const& engine, int jobs, Observer& observer) {
    make_folder(plan.folder);
    FolderLock const lock(plan.folder);
    freeze(plan, campaign_file, engine);
    return LocalExecutor(plan, engine, jobs, observer).run();
}

}  // namespace vibrotrough::campaign
