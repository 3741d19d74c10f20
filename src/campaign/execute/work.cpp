#include "campaign/execute/work.hpp"

#include "campaign/execute/case_end.hpp"
#include "campaign/execute/outcome_reason.hpp"
#include "campaign/execute/packing_run.hpp"
#include "campaign/outcome_names.hpp"
#include "campaign/state/case_state.hpp"
#include "campaign/state/file_lock.hpp"
#include "core/error.hpp"

#include <chrono>
#include <csignal>

#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

using namespace std::chrono_literals;

/// One try: the engine, looked at four times a second, until it ends, the time is over or a signal comes.
class Try {
  public:
    Try(engine::Engine const& engine, std::filesystem::path const& campaign_folder,
        PlannedCase const& planned, int packing,
        std::optional<std::chrono::steady_clock::time_point> deadline)
        : settled_(context_, engine, campaign_folder),
          deadline_(deadline),
          run_(context_, engine, settled_, planned, packing, [this](PackingOutcome const& outcome) {
              outcome_ = outcome;
              ended_ = true;
              signals_.cancel();
              clock_.cancel();
          }) {}

    PackingOutcome run() {
        signals_.async_wait([this](auto const& cancelled, int) {
            if (!cancelled) run_.interrupt();
        });
        tick();
        context_.run();
        if (late_ && outcome_.outcome == "interrupted") return time_limit_outcome();
        return outcome_;
    }

  private:
    static PackingOutcome time_limit_outcome() {
        return {false, "time-limit", "the packing was not finished within its time"};
    }

    void tick() {
        if (ended_) return;  // its timer had gone off already when the run ended
        run_.look();
        if (deadline_ && !late_ && std::chrono::steady_clock::now() > *deadline_) {
            late_ = true;
            run_.interrupt();
        }
        clock_.expires_after(250ms);
        clock_.async_wait([this](auto const& cancelled) {
            if (!cancelled) tick();
        });
    }

    boost::asio::io_context context_;
    boost::asio::signal_set signals_{context_, SIGINT, SIGTERM, SIGHUP};
    boost::asio::steady_timer clock_{context_};
    SettledPackings settled_;
    std::optional<std::chrono::steady_clock::time_point> deadline_;
    bool late_ = false;
    bool ended_ = false;
    PackingOutcome outcome_{};
    PackingRun run_;
};

engine::Engine same_engine(std::filesystem::path const& folder) {
    engine::Engine const planned = read_engine(folder);
    engine::Engine const here = engine::find_engine(planned.program);
    if (here.version == planned.version) return here;
    throw core::MissingError(
        fmt::format("{} is '{}' on this machine and '{}' where the campaign was planned; install "
                    "the same on both, or give run --liggghts another path",
                    planned.program.string(), here.version, planned.version));
}

WorkResult end_of_case(PlannedCase const& planned, std::string const& engine_version) {
    auto const result = finish_case(planned, engine_version);
    return {WorkResult::finished, result ? fmt::format("case {}: {}", planned.id, result->outcome)
                                         : fmt::format("case {}: other packings are missing", planned.id)};
}

}  // namespace

WorkResult work(std::filesystem::path const& campaign_folder, Task const& task, WorkLimits const& limits) {
    std::optional<std::chrono::steady_clock::time_point> deadline;
    if (limits.time_limit) {
        deadline = std::chrono::steady_clock::now() +
                   std::chrono::milliseconds(static_cast<long>(*limits.time_limit * 1000));
    }
    engine::Engine engine = same_engine(campaign_folder);
    engine.ranks = limits.ranks;
    PlannedCase const planned = open_case(campaign_folder, task.case_id, engine.version);
    if (task.packing > planned.scenario.measure.packings)
        throw core::InputError(fmt::format("case {} has no packing {}", planned.id, task.packing));
    auto const mine = FileLock::take(planned.folder / fmt::format(".packing-{}.lock", task.packing));
    if (!mine) {
        return {WorkResult::busy,
                fmt::format("another process runs packing {} of case {}", task.packing, planned.id)};
    }
    if (read_finished_packing(planned, task.packing)) return end_of_case(planned, engine.version);
    for (int attempt = 0;; ++attempt) {
        long const memory_kills = count_memory_kills();
        PackingOutcome const outcome =
            find_reason(planned, task.packing,
                        Try(engine, campaign_folder, planned, task.packing, deadline).run(), memory_kills);
        if (outcome.well) return end_of_case(planned, engine.version);
        if (outcome.outcome == "interrupted") return {WorkResult::interrupted, outcome.message};
        if (attempt < limits.retries && retry_makes_sense(outcome.outcome)) continue;
        record_failure(planned, task.packing, outcome);
        return {WorkResult::failed, fmt::format("case {}, packing {}: {}: {}", planned.id, task.packing,
                                                outcome.outcome, outcome.message)};
    }
}

}  // namespace vibrotrough::campaign
