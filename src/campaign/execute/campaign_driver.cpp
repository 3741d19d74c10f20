#include "campaign/execute/campaign_driver.hpp"

#include "campaign/execute/case_files.hpp"
#include "campaign/schedule/machine_speed.hpp"
#include "campaign/state/added_cases.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/case_state.hpp"
#include "campaign/state/checkpoint.hpp"
#include "campaign/state/result_summary.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "deck/estimates.hpp"
#include "engine/sole_writer.hpp"
#include "engine/stop_signals.hpp"
#include "evaluate/case.hpp"
#include "store/summary.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <set>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

/// What the files say of a case before anything is run.
struct FoundCase {
    std::optional<FoundSummary> summary = {};  ///< of its result
    bool is_damaged = false;                   ///< there is a result that cannot be used
    KnownCase known = {};                      ///< of a case that may go on
    int attempts = 0;                          ///< failed ones of earlier runs
};

/// Whether more packings or cycles could still make a result precise or steady, if the policy wants them.
bool may_go_on(PlannedCase const& planned, store::CaseRecord const& record) {
    return record.outcome != core::Outcome::finished && planned.scenario().measure.max_packings > 1;
}

/// Looks at a case. A summary that is missing is written.
FoundCase look_at(PlannedCase const& planned) {
    FoundCase found{find_summary(planned)};
    if (found.summary && found.summary->is_from_result) write_summary(planned, found.summary->record);
    if (found.summary && !may_go_on(planned, found.summary->record)) return found;
    std::error_code missing;
    found.is_damaged = !found.summary && fs::exists(planned.result_file(), missing);
    found.known = know(planned);
    if (auto const failure = read_failure(planned)) found.attempts = failure->attempts;
    return found;
}

/// What the driver knows of a case.
struct DrivenCase {
    KnownCase known;
    evaluate::EvaluatedPackings evaluated = {};  ///< measured by this process, until the case has its result
    std::set<int> in_hand = {};                  ///< packings that the executor has
    int counted = 0, done = 0;                   ///< packings of it in Progress
    double expected = 0;                         ///< work that is left of it
    int attempts = 0;                            ///< failed ones of earlier runs
    std::set<int> repaired = {};                 ///< packings that were found damaged once
    bool has_ended = false;
};

class Driver {
  public:
    Driver(Plan& plan, Policy const& policy, Executor& executor, ExecutorInputs const& inputs,
           Observer& observer)
        : plan_(plan),
          policy_(policy),
          executor_(executor),
          settings_(inputs.settings),
          foreign_commands_(inputs.foreign_commands),
          observer_(observer) {}

    Summary run(Until until) {
        for (PackingActivity& one : executor_.given_before())
            before_.insert_or_assign(one.id, std::move(one));
        take_stock_of_all();
        add_cases();
        submit_orders();
        bool const may_leave = until == Until::submitted && executor_.outlives_driver();
        while (!may_leave && !executor_.is_idle()) step();
        summary_.not_taken = static_cast<int>(executor_.not_taken());
        note_machine_speed(work_);
        summary_.interrupted = is_stopping_;
        return summary_;
    }

  private:
    void step() {
        for (; signals_heard_ < std::min(signals_.count(), 2); ++signals_heard_) {
            if (!std::exchange(is_stopping_, true)) observer_.stopping();
            executor_.interrupt();
        }
        if (!fs::exists(plan_.folder))
            throw core::MissingError(plan_.folder.string() +
                                     " was renamed or removed while its campaign ran");
        for (EndedPacking& ended : executor_.wait()) handle(ended);
        submit_orders();
        report();
    }

    void take_stock_of_all() {
        constexpr std::size_t part = 1024;  // what is known of all cases at once would fill the memory twice
        for (std::size_t begin = 0; begin < plan_.cases.size(); begin += part) {
            std::vector<FoundCase> found(std::min(part, plan_.cases.size() - begin));
            core::for_each_index(found.size(), cases_per_thread, [&] {
                return [&](std::size_t i) { found[i] = look_at(plan_.cases[begin + i]); };
            });
            for (std::size_t i = 0; i < found.size(); ++i)
                take_stock(plan_.cases[begin + i], std::move(found[i]));
        }
    }

    void take_stock(PlannedCase const& planned, FoundCase found) {
        DrivenCase& one = cases_.emplace_back(DrivenCase{{&planned, {}, {}, {}}});
        by_id_[planned.id] = &one;
        if (found.summary) {
            for (auto const& packing : found.summary->record.packings)
                progress_.core_time += packing.core_time;
            if (!may_go_on(planned, found.summary->record)) return take_result(one, *found.summary);
        }
        if (found.is_damaged)
            observer_.noticed(planned, "its result.h5 is damaged or of an older version, and is replaced");
        one.known = std::move(found.known);
        one.attempts = found.attempts;
        if (found.summary && is_exhausted(one.known, found.summary->record))
            return take_result(one, *found.summary);
        ++progress_.left;
        decide(one);
    }

    /// A result that stays as it is.
    void take_result(DrivenCase& one, FoundSummary& summary) {
        one.known.packings.clear();
        count_result(summary.record.outcome);
        one.known.result = std::move(summary.record);
        one.has_ended = true;
    }

    /// Whether a result is left as it is: the policy wants nothing more, or packings that the result was made
    /// of have been removed from the disk.
    bool is_exhausted(KnownCase const& known, store::CaseRecord const& record) const {
        return known.packings.size() < record.packings.size() || !policy_.decide(known).result.empty();
    }

    /// Asks the policy about a case, and does what it says.
    void decide(DrivenCase& one) {
        CaseDecision const decision = policy_.decide(one.known);
        count(one, decision);
        if (!decision.result.empty()) return finish(one, decision);
        for (deck::PackingPlan const& packing : decision.wanted) {
            // A run that was cut while it was continued needs nothing while fewer cycles are wanted; when it
            // is all that is missing, it is run again.
            bool const is_needed = !is_enough(one.known, packing) || !is_any_missing(one, decision);
            if (!is_done(one.known, packing) && is_needed && !one.in_hand.contains(packing.number))
                order(one, packing);
        }
    }

    static bool is_any_missing(DrivenCase const& one, CaseDecision const& decision) {
        return !std::ranges::all_of(
            decision.wanted, [&](deck::PackingPlan const& packing) { return is_enough(one.known, packing); });
    }

    /// Brings the progress up to date with what the policy wants of a case.
    void count(DrivenCase& one, CaseDecision const& decision) {
        auto const done = std::ranges::count_if(
            decision.wanted, [&](deck::PackingPlan const& packing) { return is_enough(one.known, packing); });
        progress_.packings += static_cast<int>(decision.wanted.size()) - one.counted;
        progress_.packings_done += static_cast<int>(done) - one.done;
        one.counted = static_cast<int>(decision.wanted.size());
        one.done = static_cast<int>(done);
        double cycles = 0;
        for (auto const& [number, packing] : one.known.packings)
            cycles += static_cast<double>(packing.efficiency.size());
        double const settlings =
            static_cast<double>(decision.wanted.size()) - static_cast<double>(one.known.packings.size());
        double const left = deck::work_of(*one.known.planned->prepared, std::max(0.0, settlings),
                                          std::max(0.0, decision.expected - cycles));
        work_.left += left - one.expected;
        one.expected = left;
    }

    void order(DrivenCase& one, deck::PackingPlan const& wanted) {
        PlannedCase const& planned = *one.known.planned;
        int const packing = wanted.number;
        if (is_with_executor({planned.id, packing})) {
            executor_.adopt({&planned, wanted});
            one.in_hand.insert(packing);
            ++summary_.in_queue;
            return;
        }
        fs::path const folder = planned.packing_folder(packing);
        std::error_code missing;
        bool const runs_here = !executor_.outlives_driver();
        if (runs_here) fs::remove(planned.failure_file());  // which means that the last attempt failed
        std::optional<FileLock> lock;                       // a task may be at work in the folder
        if (runs_here && fs::exists(folder, missing)) lock.emplace(require_packing(planned, packing));
        // A packing that is continued is no longer finished; its checkpoint keeps what is known of it.
        if (one.known.packings.contains(packing)) evaluate::remove_marker(folder);
        // Remains of an interrupted run would look like a run of today, unless it continues from a
        // checkpoint.
        if (lock && !one.known.failure && !has_checkpoint(folder)) {
            engine::make_sole_writer(folder);
            fs::remove_all(folder);
        }
        one.in_hand.insert(packing);
        orders_.push_back({&planned, wanted});
    }

    /// Whether an earlier run gave the packing to the executor, which still has it.
    bool is_with_executor(PackingId const& id) {
        auto const found = before_.find(id);
        if (found == before_.end() || found->second.state == PackingActivity::ended) return false;
        if (found->second.state == PackingActivity::unknown) {
            throw core::MissingError(
                fmt::format("{}, so that it is not known whether packing {} of case {} still runs; try again "
                            "when it does",
                            found->second.message, id.packing, id.case_id));
        }
        return true;
    }

    /// The longest first: what starts last should not last longest.
    void submit_orders() {
        if (orders_.empty() || is_stopping_) return;
        std::ranges::stable_sort(orders_, std::ranges::greater(),
                                 [](PackingOrder const& order) { return order.planned->prepared->work(1); });
        for (PackingOrder const& order : orders_) summary_.again += before_.contains(order.id()) ? 1 : 0;
        summary_.submitted += static_cast<int>(orders_.size());
        std::vector<PackingOrder> const orders = std::exchange(orders_, {});
        std::vector<PlannedCase const*> cases;
        for (PackingOrder const& order : orders) cases.push_back(order.planned);
        write_case_files(std::move(cases));
        if (std::string reference = executor_.submit(orders); !reference.empty())
            summary_.references.push_back(std::move(reference));
    }

    void handle(EndedPacking& ended) {
        DrivenCase& one = *by_id_.at(ended.id.case_id);
        PlannedCase const& planned = *one.known.planned;
        one.in_hand.erase(ended.id.packing);
        progress_.core_time += ended.core_time;
        work_.core_time += ended.core_time;
        if (!ended.failure) {
            work_.add(*planned.prepared, ended.has_settled, ended.cycles);
            take_in(one, ended);
            if (!one.has_ended) decide(one);
        } else if (!one.has_ended && may_retry(ended)) {
            decide(one);  // wants the same packing
        } else if (!one.has_ended && ended.failure != core::Outcome::interrupted) {
            fail(one, ended);
        }
    }

    static void take_in(DrivenCase& one, EndedPacking& ended) {
        int const packing = ended.id.packing;
        if (ended.evaluated) {
            store::PackingRecord const& record = ended.evaluated->record;
            one.known.packings[packing] = {record.efficiency, record.core_time, true};
            one.evaluated.insert_or_assign(packing, std::move(*ended.evaluated));
            return;
        }
        PlannedCase const& planned = *one.known.planned;
        fs::path const folder = planned.packing_folder(packing);
        if (auto finished = evaluate::read_finished_cycles(*planned.prepared, folder))
            one.known.packings[packing] = {std::move(finished->efficiency), finished->core_time, true};
    }

    bool may_retry(EndedPacking const& ended) {
        return retry_makes_sense(*ended.failure) && !is_stopping_ &&
               attempts_[ended.id]++ < settings_.retries;
    }

    /// Writes the result of a case. A packing that turns out to be damaged is run again, once.
    void finish(DrivenCase& one, CaseDecision const& decision) {
        PlannedCase const& planned = *one.known.planned;
        try {
            store::CaseRecord const result = finish_case(
                planned, plan_.engine_version, {decision.result, decision.cycles}, std::move(one.evaluated));
            one.known.result = store::summary_of(result);
            end_case(one);
            count_result(result.outcome);
            observer_.case_ended(planned, result.outcome, evaluate::remark_on(result));
        } catch (DamagedPacking const& damaged) {
            if (!one.repaired.insert(damaged.packing()).second) throw;
            evaluate::remove_marker(planned.packing_folder(damaged.packing()));
            one.known.packings.erase(damaged.packing());
            decide(one);
            return;
        }
        if (have_taken_stock_) add_cases();
    }

    void fail(DrivenCase& one, EndedPacking const& ended) {
        PlannedCase const& planned = *one.known.planned;
        one.known.failure = ended.failure;
        executor_.withdraw(planned);
        std::erase_if(orders_, [&](PackingOrder const& order) { return order.planned == &planned; });
        if (!ended.is_recorded)
            record_failure(planned, ended.id.packing, *ended.failure, ended.message, one.attempts);
        end_case(one);
        progress_.failed = ++summary_.failed;
        observer_.case_ended(planned, *ended.failure, ended.message);
        add_cases();
    }

    void end_case(DrivenCase& one) {
        one.has_ended = true;
        work_.left -= one.expected;
        one.expected = 0;
        one.known.packings.clear();
        one.evaluated.clear();
        --progress_.left;
    }

    void count_result(core::Outcome outcome) {
        ++progress_.finished;
        ++(outcome == core::Outcome::finished ? summary_.finished : summary_.unsure);
    }

    /// Lets the policy add cases, until it wants no more.
    void add_cases() {
        have_taken_stock_ = true;
        std::vector<KnownCase const*> known;
        for (DrivenCase const& one : cases_) known.push_back(&one.known);
        for (scenario::Scenario const& scenario : policy_.further_cases(known)) {
            check_foreign_commands(plan_.folder.string(), scenario, foreign_commands_);
            if (PlannedCase const* const added = add_case(plan_, scenario))
                take_stock(*added, look_at(*added));
        }
    }

    void report() {
        progress_.engines = executor_.running();
        progress_.running = static_cast<int>(progress_.engines.size());
        progress_.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        WorkOfRun work = work_;
        for (RunningPacking const& one : progress_.engines) {
            double const before = work.done;
            work.add(*one.planned->prepared, one.has_settled, one.cycles);
            work.left -= work.done - before;
            work.core_time += one.core_time;
        }
        TimeToGo const left = time_to_go(work, progress_.elapsed);
        progress_.time_to_go = left.wall;
        progress_.core_time_to_go = left.core;
        Progress shown = progress_;
        shown.core_time += work.core_time - work_.core_time;
        observer_.progressed(shown);
    }

    Plan& plan_;
    Policy const& policy_;
    Executor& executor_;
    scenario::RunSettings const& settings_;
    ForeignCommands const& foreign_commands_;
    Observer& observer_;
    engine::StopSignals signals_;
    std::deque<DrivenCase> cases_;
    std::map<std::string, DrivenCase*> by_id_;
    std::map<PackingId, PackingActivity> before_;  ///< what earlier runs gave to the executor
    std::map<PackingId, int> attempts_;            ///< failed ones of this run
    std::vector<PackingOrder> orders_;             ///< not yet submitted
    std::chrono::steady_clock::time_point const start_ = std::chrono::steady_clock::now();
    WorkOfRun work_;  ///< but for the packings under way
    Progress progress_;
    Summary summary_;
    bool have_taken_stock_ = false;
    bool is_stopping_ = false;
    int signals_heard_ = 0;
};

}  // namespace

Summary run_campaign(Plan& plan, fs::path const& campaign_file, Policy const& policy,
                     ExecutorKind const& kind, ExecutorInputs const& inputs, Until until,
                     Observer& observer) {
    for (PlannedCase const& planned : plan.cases)  // added ones may come from elsewhere
        check_foreign_commands(plan.folder.string(), planned.scenario(), inputs.foreign_commands);
    core::make_folder(plan.folder);
    FileLock const lock = lock_campaign(plan.folder);
    freeze(plan, campaign_file, inputs.engine);
    refuse_other_executors(plan.folder, kind);
    auto const executor = kind.make(inputs);
    return Driver(plan, policy, *executor, inputs, observer).run(until);
}

}  // namespace vibrotrough::campaign
