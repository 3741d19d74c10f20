#include "campaign/execute/case_files.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/execute/packing_run.hpp"
#include "campaign/execute/ranks.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "evaluate/packing.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <list>
#include <map>
#include <optional>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <fmt/format.h>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Why the folder takes no more, if it does not: tried, because free space alone says nothing about quotas.
std::optional<std::string> full_disk(fs::path const& folder) {
    fs::path const probe = folder / fmt::format(".probe-{}", ::getpid());
    std::optional<std::string> reason;
    try {
        core::write_file_atomically(probe, std::string(256 << 10, 'x'));
    } catch (core::DiskFullError const& error) {
        reason = error.what();
    } catch (core::MissingError const&) {
        // Not full, but the folder is gone or may not be written to.
    }
    std::error_code missing;
    fs::remove(probe, missing);
    return reason;
}

/// How many processes the kernel of this machine has killed for want of memory so far; 0 where it does not
/// say.
long count_memory_kills() {
    try {
        std::string const counts = core::read_file("/proc/vmstat");
        constexpr std::string_view name = "\noom_kill ";
        auto const at = counts.find(name);
        return at == std::string::npos ? 0 : std::strtol(counts.c_str() + at + name.size(), nullptr, 10);
    } catch (core::MissingError const&) {
        return 0;  // another kernel
    }
}

/// Finds the cause behind a packing's failure: a full disk leaves the engine silent, lack of memory shows as
/// a signal, and a simulation that diverged as a wrong number. Adds how far the run had come.
/// @param memory_kills  count_memory_kills() from before the run
PackingEnd find_cause(PlannedCase const& planned, int packing, PackingEnd end, long memory_kills) {
    if (!end.failure || end.failure == core::Outcome::interrupted || end.failure == core::Outcome::disk_full)
        return end;  // it is known already
    fs::path const folder = planned.packing_folder(packing);
    evaluate::RunExtent const extent = evaluate::extent_of_run(*planned.prepared, folder);
    if (end.signal == SIGKILL && count_memory_kills() > memory_kills) {
        end.failure = core::Outcome::out_of_memory;
    } else if (auto const reason = full_disk(planned.folder);
               reason && end.failure != core::Outcome::out_of_memory) {
        end.failure = core::Outcome::disk_full;
        end.message = fmt::format("{} takes no more ({})", folder.string(), *reason);
    } else if (end.signal == SIGXFSZ) {
        end.failure = core::Outcome::disk_full;
        end.message = fmt::format("a file of {} cannot grow ({})", folder.string(), core::reason_of(EFBIG));
    } else if (extent.diverged) {
        end.failure = core::Outcome::diverged;
        end.message =
            fmt::format("cycles.csv holds a NaN or a speed above 100 times the trough's ({})", end.message);
    }
    end.message += fmt::format(" [packing {}, after {} cycles]", packing, extent.cycles);
    return end;
}

/// A packing that runs.
struct Running {
    PackingOrder order{};
    int ranks = 1;
    long memory_kills = 0;      ///< of the machine, when it started
    bool is_over_time = false;  ///< run.time_limit has passed
    Clock::time_point start = Clock::now();
    std::optional<FileLock> lock = {};  ///< of the packing, as a task of a cluster takes it
    std::unique_ptr<PackingRun> run = {};

    double elapsed() const { return std::chrono::duration<double>(Clock::now() - start).count(); }
};

class LocalExecutor : public Executor {
  public:
    explicit LocalExecutor(ExecutorInputs const& inputs)
        : inputs_(inputs),
          settled_(context_, engine_with(inputs.settings.ranks.value_or(1)), inputs.campaign_folder) {}

    std::vector<PackingActivity> given_before() override {
        settled_.remove_leftovers();
        return {};
    }

    std::string submit(std::vector<PackingOrder> const& orders) override {
        queue_.insert(queue_.end(), orders.begin(), orders.end());
        return {};
    }

    void withdraw(PlannedCase const& planned) override {
        std::erase_if(queue_, [&](PackingOrder const& order) { return order.planned == &planned; });
    }

    std::vector<EndedPacking> wait() override {
        start_queued();
        context_.restart();
        auto const deadline = Clock::now() + 250ms;
        while (ended_.empty() && !running_.empty() && context_.run_one_until(deadline) > 0) {
        }
        if (Clock::now() >= next_look_) {
            next_look_ = Clock::now() + 250ms;
            for (Running& one : running_) inspect(one);
        }
        return std::exchange(ended_, {});
    }

    bool is_idle() const override { return running_.empty() && ended_.empty() && queue_.empty(); }

    void interrupt() override {
        queue_.clear();
        Stop const stop = std::exchange(is_interrupted_, true) ? Stop::now : Stop::with_checkpoint;
        for (Running const& one : running_) one.run->interrupt(stop);
    }

    std::vector<RunningPacking> running() const override {
        std::vector<RunningPacking> shown;
        for (Running const& one : running_) {
            int const cycles = one.run->cycles(), wanted = one.order.packing.cycles;
            double const to_go = cycles > 0 ? one.run->seconds_per_cycle() * (wanted - cycles) : -1;
            shown.push_back({one.order.planned, one.order.packing.number, cycles, wanted, one.run->estimate(),
                             one.elapsed(), to_go, one.ranks, one.run->is_moving(), one.run->has_settled(),
                             one.run->core_time()});
        }
        return shown;
    }

    bool outlives_driver() const override { return false; }

  private:
    using Place = std::list<Running>::iterator;

    void start_queued() {
        while (!queue_.empty()) {
            PackingOrder const order = queue_.front();
            int const ranks = ranks_of(order);
            if (!running_.empty() && busy_cores() + ranks > inputs_.cores) return;
            queue_.pop_front();
            start(order, ranks);
        }
    }

    int busy_cores() const {
        int cores = 0;
        for (Running const& one : running_) cores += one.ranks;
        return cores;
    }

    /// Several ranks only where there are fewer packings left than cores.
    int ranks_of(PackingOrder const& order) const {
        int const left = static_cast<int>(queue_.size() + running_.size());
        return choose_ranks(inputs_.settings, order.planned->scenario(), std::max(1, inputs_.cores / left));
    }

    engine::Engine const& engine_with(int ranks) {
        auto& engine = engines_[ranks];
        engine = inputs_.engine;
        engine.ranks = ranks;
        return engine;
    }

    void start(PackingOrder const& order, int ranks) {
        PlannedCase const& planned = *order.planned;
        running_.push_back({order, ranks, count_memory_kills()});
        auto const place = std::prev(running_.end());
        try {
            if (!inputs_.holds_lock) place->lock.emplace(require_packing(planned, order.packing.number));
            place->run =
                std::make_unique<PackingRun>(context_, engine_with(ranks), settled_, planned, order.packing,
                                             [this, place](PackingEnd const& end) { ended(place, end); });
        } catch (...) {
            running_.erase(place);
            throw;
        }
    }

    void inspect(Running& one) {
        one.run->inspect();
        auto const& limit = inputs_.settings.time_limit;
        if (one.is_over_time || !limit || one.elapsed() < *limit) return;
        one.is_over_time = true;
        one.run->interrupt(Stop::now);
    }

    void ended(Place place, PackingEnd end) {
        PackingOrder const order = place->order;
        if (place->is_over_time && end.failure == core::Outcome::interrupted) {
            end = {core::Outcome::time_limit,
                   fmt::format("not finished after {:.0f} s", inputs_.settings.time_limit.value_or(0))};
        }
        end = find_cause(*order.planned, order.packing.number, end, place->memory_kills);
        EndedPacking result{order.id(),
                            end.failure,
                            end.message,
                            place->run->cycles(),
                            place->run->core_time(),
                            place->run->has_settled()};
        if (!end.failure) result.evaluated = place->run->take_evaluated();
        // The run is in the middle of its own call: it is destroyed after it has returned.
        boost::asio::post(context_, [run = std::shared_ptr<PackingRun>(std::move(place->run))] {});
        running_.erase(place);
        ended_.push_back(std::move(result));
        if (end.failure) check_engine();
    }

    /// Without its program no packing can run: the cases have not failed.
    void check_engine() const {
        std::error_code ignored;
        if (fs::exists(inputs_.engine.program, ignored)) return;
        throw core::MissingError(
            fmt::format("the engine {} is gone; put it back, or name another with --liggghts PATH",
                        inputs_.engine.program.string()));
    }

    ExecutorInputs inputs_;
    std::map<int, engine::Engine> engines_;  ///< by number of ranks
    boost::asio::io_context context_;
    std::deque<PackingOrder> queue_;
    SettledPackings settled_;
    std::list<Running> running_;
    std::vector<EndedPacking> ended_;
    Clock::time_point next_look_ = Clock::now();
    bool is_interrupted_ = false;
};

}  // namespace

std::unique_ptr<Executor> make_local_executor(ExecutorInputs const& inputs) {
    return std::make_unique<LocalExecutor>(inputs);
}

}  // namespace vibrotrough::campaign
