#pragma once

#include "campaign/plan.hpp"
#include "deck/deck.hpp"
#include "engine/engine.hpp"
#include "measure/estimate.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace vibrotrough::campaign {

/// How a packing's run ended.
struct PackingOutcome {
    bool well;            ///< the packing is finished and marked so
    std::string outcome;  ///< name of the failure
    std::string message;
};

/// One packing being simulated: a fresh deck folder, the engine on it, and the question after each look at
/// its cycles whether they are enough.
class PackingRun {
  public:
    /// Writes the deck (over whatever an earlier attempt left) and starts the engine. `on_end` is called
    /// once, from `context`; not after destruction.
    /// @throws MissingError when the disk refuses or the engine cannot be started
    PackingRun(boost::asio::io_context& context, engine::Engine const& engine, PlannedCase const& planned,
               int packing, std::function<void(PackingOutcome const&)> on_end);

    /// Looks at the cycles written so far; tells the engine to end when they are known well enough.
    void look();

    /// Ends the engine soon; `on_end` then reports "interrupted".
    void interrupt();

    PlannedCase const& planned() const { return planned_; }
    int cycles() const { return cycles_; }

    /// Of the cycles seen so far; nothing before the first look at them.
    std::optional<measure::PackingEstimate> const& estimate() const { return estimate_; }

  private:
    PackingOutcome judge(engine::ExitStatus status);

    PlannedCase const& planned_;
    int packing_;
    std::filesystem::path folder_;
    deck::Deck deck_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::string started_;
    int cycles_ = 0;
    std::optional<measure::PackingEstimate> estimate_;
    bool told_to_end_ = false;
    bool interrupted_ = false;
    std::uintmax_t seen_size_ = 0;
    std::unique_ptr<engine::EngineProcess> process_;
};

}  // namespace vibrotrough::campaign
