#pragma once

#include "campaign/execute/executors.hpp"
#include "campaign/schedule/policy.hpp"
#include "campaign/state/plan.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::campaign {

/// Where a campaign stands.
struct Progress {
    int finished = 0;                     ///< cases with a result
    int failed = 0;                       ///< cases that failed in this run
    int running = 0;                      ///< packings being simulated
    int left = 0;                         ///< cases neither finished nor failed, running ones included
    int packings_done = 0;                ///< of all cases that this run works on, in this run and before
    int packings = 0;                     ///< that these cases need, as far as it is known
    double elapsed = 0;                   ///< s
    double time_to_go = -1;               ///< s, negative while unknown
    double core_time = 0;                 ///< core seconds spent on results and on what runs now
    double core_time_to_go = -1;          ///< core seconds, negative while unknown
    std::vector<RunningPacking> engines;  ///< the packings that are being simulated
};

/// Receives what happens during a run, from the thread that runs the campaign.
class Observer {
  public:
    virtual ~Observer() = default;
    virtual void progressed(Progress const& progress) = 0;  ///< about four times a second
    /// Called once for each case that ends: with its outcome, and why it failed.
    virtual void case_ended(PlannedCase const& planned, core::Outcome outcome,
                            std::string const& message) = 0;
    /// Called when something of a case that a person may want to know is about to be changed.
    virtual void noticed(PlannedCase const&, std::string const&) {}
    /// Called once when a signal has asked for a stop: engines end the cycle that they are in.
    virtual void stopping() {}
};

/// What a run came to.
struct Summary {
    int finished = 0;                     ///< cases with a result and outcome "finished"
    int unsure = 0;                       ///< cases with a result and another outcome
    int failed = 0;                       ///< cases that failed in this run
    int submitted = 0;                    ///< packings handed to the executor
    int not_taken = 0;                    ///< packings that the executor had no room for in the end
    int again = 0;                        ///< of these, those that an earlier run had handed to it
    int in_queue = 0;                     ///< packings that the executor had from an earlier run
    std::vector<std::string> references;  ///< what the user can follow the packings by, see Executor::submit
    bool interrupted = false;             ///< a signal stopped the run
};

/// When run_campaign() returns.
enum class Until {
    done,       ///< all cases have ended
    submitted,  ///< all packings are handed over, where they go on without this process
};

/// Makes the campaign's folder, freezes the campaign in it, and runs every packing that the policy wants, the
/// longest expected first. A failed case does not stop the others. The first SIGINT, SIGTERM or SIGHUP stops
/// the run after the cycles that the engines are in, a second one at once; the same call continues it.
/// @param plan           cases that the policy adds are appended
/// @param campaign_file  that the plan was made from
/// @param kind           of executor
/// @throws core::MissingError when another process drives the campaign or another executor holds packings of
/// it, the executor refuses, or the disk does; packings that cannot go on alone are stopped first
Summary run_campaign(Plan& plan, std::filesystem::path const& campaign_file, Policy const& policy,
                     ExecutorKind const& kind, ExecutorInputs const& inputs, Until until, Observer& observer);

}  // namespace vibrotrough::campaign
