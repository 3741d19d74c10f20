#pragma once

#include "campaign/state/overview.hpp"
#include "campaign/state/plan.hpp"
#include "core/outcome.hpp"
#include "deck/deck.hpp"
#include "evaluate/packing.hpp"
#include "measure/estimate.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// A packing that an executor is to run.
struct PackingOrder {
    PlannedCase const* planned;  ///< the case
    deck::PackingPlan packing;   ///< its number, its start and how many cycles are wanted of it

    /// Which packing it is.
    PackingId id() const { return {planned->id, packing.number}; }
};

/// A packing that an executor has finished with.
struct EndedPacking {
    PackingId id;                          ///< which packing
    std::optional<core::Outcome> failure;  ///< none when the packing is finished and has its marker
    std::string message;                   ///< why it failed
    int cycles = 0;                        ///< simulated
    double core_time = 0;                  ///< s, processor time of the engine in this run, all ranks
    bool has_settled = false;              ///< in this run
    /// What was measured, when this process measured it; otherwise it is read from the packing's folder.
    std::optional<evaluate::EvaluatedPacking> evaluated = {};
    bool is_recorded = false;  ///< failure.json was written already, by the process that ran the packing
};

/// A packing that is being simulated now, for progress displays.
struct RunningPacking {
    PlannedCase const* planned;                        ///< the case
    int packing;                                       ///< its number, from 1
    int cycles;                                        ///< simulated so far
    int cycles_wanted;                                 ///< in the end
    std::optional<measure::PackingEstimate> estimate;  ///< of velocity efficiency, from the cycles so far
    double elapsed;                                    ///< s
    double time_to_go;                                 ///< s, negative while unknown
    int ranks;                                         ///< MPI ranks of its engine
    bool is_moving = false;                            ///< its trough; it settles before
    bool has_settled = false;                          ///< in this run, and not before its checkpoint
    double core_time = 0;                              ///< s, processor time of its engine so far, all ranks
};

/// Runs packings: on this machine, or on a cluster. An executor knows no policy: it runs what it is given.
///
/// To add a kind, write a class in one file, and list it in executors.cpp.
class Executor {
  public:
    virtual ~Executor() = default;

    /// Packings of the campaign that this kind of executor was given, by this process or an earlier one, and
    /// that have not been seen to finish. Asked once, at the start.
    virtual std::vector<PackingActivity> given_before() { return {}; }

    /// Takes on packings, in this order. The references must outlive the executor.
    /// @return what the user can follow them by, for example "job 4711"; empty when there is nothing of the
    /// kind
    /// @throws core::MissingError when the packings are refused
    virtual std::string submit(std::vector<PackingOrder> const& orders) = 0;

    /// Packings that it was given and has no room for yet. As long as the process lives, wait() passes them
    /// on.
    virtual std::size_t not_taken() const { return 0; }

    /// Takes over a packing that given_before() reported as waiting or running, so that wait() reports its
    /// end.
    virtual void adopt(PackingOrder const& order) { static_cast<void>(order); }

    /// Gives up packings of a case that have not started, because the case has failed.
    virtual void withdraw(PlannedCase const& planned) { static_cast<void>(planned); }

    /// Waits a moment, at most about a quarter of a second, and returns the packings that have ended since
    /// the last call.
    /// @throws core::MissingError when no packing can run any more (no engine, no disk)
    virtual std::vector<EndedPacking> wait() { return {}; }

    /// Whether no packing is left that was given to it.
    virtual bool is_idle() const { return true; }

    /// Asks it to come to an end: packings that cannot go on without this process end as interrupted, at the
    /// first call after the cycle that they are in, at the second at once.
    virtual void interrupt() {}

    /// The packings that it simulates now, as far as it knows their progress.
    virtual std::vector<RunningPacking> running() const { return {}; }

    /// Whether packings go on when this process ends. If so, `run` may return when all are submitted.
    virtual bool outlives_driver() const = 0;
};

}  // namespace vibrotrough::campaign
