#include "campaign/execute/packing_worker.hpp"

#include "campaign/execute/case_files.hpp"
#include "campaign/execute/failure_cause.hpp"
#include "campaign/execute/packing_run.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/file_lock.hpp"
#include "core/error.hpp"
#include "engine/binary_watch.hpp"
#include "engine/certificate.hpp"
#include "engine/stop_signals.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>

#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

using namespace std::chrono_literals;

/// One attempt: the run, inspected four times a second, until it ends, its time is over or a signal comes.
class Attempt {
  public:
    Attempt(engine::Engine const& engine, std::filesystem::path const& campaign_folder,
            PlannedCase const& planned, deck::PackingPlan const& packing,
            std::optional<std::chrono::steady_clock::time_point> deadline)
        : settled_(context_, engine, campaign_folder),
          deadline_(deadline),
          run_(context_, engine, settled_, planned, packing, [this](PackingEnd const& end) {
              end_ = end;
              ended_ = true;
              signals_.cancel();
              clock_.cancel();
          }) {}

    PackingEnd run() {
        engine::add_stop_signals(signals_);
        wait_for_signal(Stop::with_checkpoint);
        tick();
        context_.run();
        // A scheduler's own signal at the end of its time may come before the next look at the clock.
        bool const is_late = deadline_ && std::chrono::steady_clock::now() > *deadline_;
        if (is_late && end_.failure == core::Outcome::interrupted)
            return {core::Outcome::time_limit, "the packing was not finished within its time"};
        return end_;
    }

    /// What was measured, of a run that did not fail.
    evaluate::EvaluatedPacking take_evaluated() { return run_.take_evaluated(); }

  private:
    /// The first signal asks for a checkpoint at the end of the cycle, a second one does not wait for it.
    void wait_for_signal(Stop stop) {
        signals_.async_wait([this, stop](auto const& cancelled, int) {
            if (cancelled) return;
            run_.interrupt(stop);
            wait_for_signal(Stop::now);
        });
    }

    void tick() {
        if (ended_) return;  // its timer had gone off already when the run ended
        run_.inspect();
        if (deadline_ && !is_over_time_ && std::chrono::steady_clock::now() > *deadline_) {
            is_over_time_ = true;
            run_.interrupt(Stop::now);
        }
        clock_.expires_after(250ms);
        clock_.async_wait([this](auto const& cancelled) {
            if (!cancelled) tick();
        });
    }

    boost::asio::io_context context_;
    boost::asio::signal_set signals_{context_};
    boost::asio::steady_timer clock_{context_};
    SettledPackings settled_;
    std::optional<std::chrono::steady_clock::time_point> deadline_;
    bool is_over_time_ = false;
    bool ended_ = false;
    PackingEnd end_{};
    PackingRun run_;
};

/// Whether the process was asked to stop. While one of these exists, no signal ends the process: one that
/// comes between two runs, or while the last is evaluated, counts before the next run begins.
class StopRequest {
  public:
    StopRequest() {
        engine::add_stop_signals(signals_);
        signals_.async_wait([this](auto const& cancelled, int) { is_made_ = !cancelled; });
    }
    bool is_made() {
        context_.poll();
        return is_made_;
    }

  private:
    boost::asio::io_context context_;
    boost::asio::signal_set signals_{context_};
    bool is_made_ = false;
};

engine::Engine same_engine(std::filesystem::path const& folder) {
    engine::Engine const planned = read_engine(folder);
    engine::Engine here = engine::find_engine(planned.program);
    if (here.version != planned.version) {
        throw core::MissingError(
            fmt::format("{} is '{}' on this machine and '{}' where the campaign was planned; install "
                        "the same on both, or give run --liggghts another path",
                        planned.program.string(), here.version, planned.version));
    }
    engine::EngineIdentity const identity = engine::identify(here);
    here.binary_sha256 = identity.binary_sha256();
    if (!planned.binary_sha256.empty() && here.binary_sha256 != planned.binary_sha256) {
        throw core::MissingError(
            fmt::format("{} is not the binary that the campaign was planned with, although it names the same "
                        "version; call "
                        "'vibrotrough run' again, which tests it",
                        planned.program.string()));
    }
    here.watch = std::make_shared<engine::BinaryWatch const>(identity);
    return here;
}

/// What the policy wants of a packing; none when it does not want it.
std::optional<deck::PackingPlan> find_wanted(CaseDecision const& decision, int packing) {
    auto const found = std::ranges::find(decision.wanted, packing, &deck::PackingPlan::number);
    return found == decision.wanted.end() ? std::nullopt : std::optional(*found);
}

/// @param evaluated  packings that this process measured itself
WorkResult finish_if_enough(KnownCase const& known, CaseDecision const& decision,
                            std::string const& engine_version, evaluate::EvaluatedPackings evaluated) {
    PlannedCase const& planned = *known.planned;
    std::string const name = planned.label.empty() ? fmt::format("case {}", planned.id)
                                                   : fmt::format("case {} ({})", planned.id, planned.label);
    if (decision.result.empty()) {
        auto const missing = std::ranges::count_if(
            decision.wanted, [&](deck::PackingPlan const& packing) { return !is_done(known, packing); });
        return {WorkResult::finished,
                fmt::format("{}: {} packing{} missing; 'vibrotrough run' starts those that no task works on",
                            name, missing, missing == 1 ? " is" : "s are")};
    }
    auto const result =
        finish_case(planned, engine_version, {decision.result, decision.cycles}, std::move(evaluated));
    return {WorkResult::finished, fmt::format("{}: {}", name, name_of(result.outcome))};
}

}  // namespace

WorkResult work(std::filesystem::path const& campaign_folder, PackingId const& id, WorkLimits const& limits,
                Policy const& policy) {
    StopRequest stop;
    std::optional<std::chrono::steady_clock::time_point> deadline;
    if (limits.time_limit) {
        deadline = std::chrono::steady_clock::now() +
                   std::chrono::milliseconds(static_cast<long>(*limits.time_limit * 1000));
    }
    engine::Engine engine = same_engine(campaign_folder);
    engine.ranks = limits.ranks;
    PlannedCase const planned = open_case(campaign_folder, id.case_id, engine.version);
    check_foreign_commands((planned.folder / "scenario.toml").string(), planned.scenario(),
                           limits.foreign_commands);
    auto const lock = lock_packing(planned, id.packing);
    if (!lock) {
        return {WorkResult::busy,
                fmt::format("another process runs packing {} of case {}", id.packing, planned.id)};
    }
    evaluate::EvaluatedPackings evaluated;
    for (int attempt = 0;; ++attempt) {
        // Asked again after each run: when this packing was the last of its round, more cycles of it may be
        // wanted.
        KnownCase const known = know(planned);
        CaseDecision const decision = policy.decide(known);
        auto const packing = find_wanted(decision, id.packing);
        if (!packing || is_done(known, *packing))
            return finish_if_enough(known, decision, engine.version, std::move(evaluated));
        if (stop.is_made()) return {WorkResult::interrupted, "the run was interrupted"};
        evaluate::remove_marker(planned.packing_folder(id.packing));  // of a run with fewer cycles
        long const memory_kills = count_memory_kills();
        Attempt running(engine, campaign_folder, planned, *packing, deadline);
        PackingEnd const end = find_cause(planned, id.packing, running.run(), memory_kills);
        if (!end.failure) {
            evaluated.insert_or_assign(id.packing, running.take_evaluated());
            attempt = -1;
            continue;
        }
        if (end.failure == core::Outcome::interrupted) return {WorkResult::interrupted, end.message};
        if (attempt < limits.retries && retry_makes_sense(*end.failure)) continue;
        record_failure(planned, id.packing, *end.failure, end.message);
        return {WorkResult::failed, fmt::format("case {}, packing {}: {}: {}", planned.id, id.packing,
                                                name_of(*end.failure), end.message)};
    }
}

}  // namespace vibrotrough::campaign
