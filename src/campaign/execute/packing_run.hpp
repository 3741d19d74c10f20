#pragma once

#include "campaign/execute/settled_packings.hpp"
#include "campaign/state/checkpoint.hpp"
#include "campaign/state/plan.hpp"
#include "deck/deck.hpp"
#include "engine/engine.hpp"
#include "evaluate/packing.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace vibrotrough::campaign {

/// How a run is stopped before its end.
enum class Stop {
    with_checkpoint,  ///< after the cycle that it is in, so that nothing of it is lost
    now,              ///< what was simulated since the last checkpoint is lost
};

/// One packing being simulated: its settled packing, then the engine on the moving trough until it has the
/// cycles that are wanted. A run that was cut, or that has fewer cycles than are wanted now, continues from
/// its last checkpoint.
class PackingRun {
  public:
    /// Starts the run. `on_end` is called once, from `context`; not after destruction. All references must
    /// outlive the run.
    /// @throws MissingError when the disk refuses or the engine cannot be started (also from `context`)
    PackingRun(boost::asio::io_context& context, engine::Engine const& engine, SettledPackings& settled,
               PlannedCase const& planned, deck::PackingPlan const& packing,
               std::function<void(PackingEnd const&)> on_end);
    ~PackingRun();

    /// Inspects the cycles written so far, and seals a new checkpoint.
    void inspect();

    /// Ends the engine; `on_end` then reports "interrupted". An engine that ends no cycle for a minute, or
    /// for four cycles, is not waited for.
    void interrupt(Stop stop);

    /// The case.
    PlannedCase const& planned() const { return planned_; }
    /// Cycles seen so far.
    int cycles() const { return cycles_; }
    /// s on the moving trough, also before the last checkpoint, over the cycles seen so far; 0 before the
    /// first.
    double seconds_per_cycle() const;
    /// Whether its trough moves.
    bool is_moving() const { return process_ != nullptr; }
    /// Whether it has settled in this run, and not before its checkpoint.
    bool has_settled() const { return has_settled_; }
    /// s, processor time of the engine in this run, all ranks.
    double core_time() const;

    /// What was measured, once the packing is finished.
    evaluate::EvaluatedPacking take_evaluated() { return std::move(evaluated_.value()); }

    /// Of the cycles seen so far; none before the first inspection.
    std::optional<measure::PackingEstimate> const& estimate() const { return estimate_; }

  private:
    void begin();
    void start_on(PackingEnd const& settled, std::filesystem::path const& restart);
    void continue_from(Checkpoint const& checkpoint);
    void resume(Checkpoint const& checkpoint);
    PackingEnd conclude(long last_step);
    void start_engine(std::optional<Checkpoint> const& checkpoint);
    void seal();
    double wall_time() const;
    std::optional<PackingEnd> judge(engine::ExitStatus status);
    std::optional<PackingEnd> go_on();

    boost::asio::io_context& context_;
    engine::Engine const& engine_;
    SettledPackings& settled_;
    PlannedCase const& planned_;
    deck::PackingPlan packing_;
    std::function<void(PackingEnd const&)> on_end_;
    std::filesystem::path folder_;
    deck::Deck deck_;
    bool has_settled_ = false;
    std::chrono::steady_clock::time_point start_;
    double earlier_wall_time_ = 0;    ///< s, of the engine before the checkpoint
    double earlier_core_time_ = 0;    ///< s, the same of its processor time
    double core_time_ = 0;            ///< s, of the engine since it was last started
    double core_time_of_pauses_ = 0;  ///< s, of the engine in this run before
    std::string started_;
    std::string engine_certificate_;
    int cycles_ = 0;
    int stop_ = 0;  ///< cycle after which the engine ends
    std::optional<measure::PackingEstimate> estimate_;
    std::optional<evaluate::EvaluatedPacking> evaluated_;
    int sealed_cycle_ = 0;
    bool interrupted_ = false;
    std::chrono::steady_clock::time_point grown_ = std::chrono::steady_clock::now();  ///< cycles.csv, last
    std::uintmax_t seen_size_ = 0;
    std::unique_ptr<engine::EngineProcess> process_;
    std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace vibrotrough::campaign
