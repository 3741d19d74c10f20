#include "campaign/execute/packing_worker.hpp"

#include "campaign/execute/case_files.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "core/error.hpp"
#include "engine/certificate.hpp"
#include "engine/stop_signals.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

using Clock = std::chrono::steady_clock;

/// Runs a packing on this machine, as a driver does, until it has ended or a signal comes. The first signal
/// asks for a checkpoint at the end of the cycle, a second one does not wait for it.
EndedPacking run(ExecutorInputs const& inputs, PackingOrder const& order, engine::StopSignals& signals) {
    auto const executor = make_local_executor(inputs);
    executor->submit({order});
    int heard = 0;
    while (!executor->is_idle()) {
        for (; heard < std::min(signals.count(), 2); ++heard) executor->interrupt();
        for (EndedPacking& ended : executor->wait()) {
            // Who ends a task sends the signal to its engine, too.
            if (ended.failure == core::Outcome::engine_crashed && signals.count() > 0)
                ended.failure = core::Outcome::interrupted;
            return std::move(ended);
        }
    }
    return {order.id(), core::Outcome::interrupted, "the run was interrupted"};
}

engine::Engine same_engine(std::filesystem::path const& folder) {
    engine::Engine const planned = read_engine(folder);
    engine::Engine here = engine::find_engine(planned.program);
    if (here.version != planned.version) {
        throw core::MissingError(
            fmt::format("{} is '{}' on this machine and '{}' where the campaign was planned; install "
                        "the same on both, or give run --liggghts another path",
                        planned.program.string(), here.version, planned.version));
    }
    identify(here);
    if (planned.binary_sha256.empty() || here.binary_sha256 == planned.binary_sha256) return here;
    throw core::MissingError(
        fmt::format("{} is not the binary that the campaign was planned with, although it names the same "
                    "version; call 'vibrotrough run' again, which tests it",
                    planned.program.string()));
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
    engine::StopSignals signals;  // from now on none ends the process
    std::optional<Clock::time_point> deadline;
    if (limits.time_limit)
        deadline = Clock::now() + std::chrono::milliseconds(static_cast<long>(*limits.time_limit * 1000));
    ExecutorInputs inputs{campaign_folder, same_engine(campaign_folder), {}, limits.ranks, {}};
    inputs.engine.ranks = limits.ranks;
    inputs.settings.ranks = limits.ranks;
    inputs.holds_lock = true;
    std::string const& engine_version = inputs.engine.version;
    PlannedCase const planned = open_case(campaign_folder, id.case_id, engine_version);
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
            return finish_if_enough(known, decision, engine_version, std::move(evaluated));
        if (signals.count() > 0) return {WorkResult::interrupted, "the run was interrupted"};
        evaluate::remove_marker(planned.packing_folder(id.packing));  // of a run with fewer cycles
        if (deadline)
            inputs.settings.time_limit = std::chrono::duration<double>(*deadline - Clock::now()).count();
        EndedPacking ended = run(inputs, {&planned, *packing}, signals);
        if (!ended.failure) {
            evaluated.insert_or_assign(id.packing, std::move(*ended.evaluated));
            attempt = -1;
            continue;
        }
        // A scheduler's own signal at the end of its time may come before the next look at the clock.
        bool const is_late = deadline && Clock::now() > *deadline;
        if (is_late && ended.failure == core::Outcome::interrupted)
            ended = {id, core::Outcome::time_limit, "the packing was not finished within its time"};
        if (ended.failure == core::Outcome::interrupted) return {WorkResult::interrupted, ended.message};
        if (attempt < limits.retries && retry_makes_sense(*ended.failure)) continue;
        record_failure(planned, id.packing, *ended.failure, ended.message);
        return {WorkResult::failed, fmt::format("case {}, packing {}: {}: {}", planned.id, id.packing,
                                                name_of(*ended.failure), ended.message)};
    }
}

}  // namespace vibrotrough::campaign
