#pragma once

#include "scenario/model/scenario.hpp"

#include <chrono>

namespace vibrotrough::campaign {

/// Guesses how long the rest of a campaign takes, from the grain-steps done so far and how fast they went.
class TimeToGo {
  public:
    void expect(scenario::Scenario const& scenario);            ///< one more packing to run
    void drop(scenario::Scenario const& scenario);              ///< a packing that will not be run, or failed
    void done(scenario::Scenario const& scenario, int cycles);  ///< a packing that took this many cycles

    /// Grain-steps of a packing that takes this many cycles.
    double work(scenario::Scenario const& scenario, double cycles) const;

    double elapsed() const;  ///< s since the start

    /// @param under_way  grain-steps done by the packings that run now
    /// @return s, negative while nothing is known
    double seconds(double under_way) const;

  private:
    double mean_cycles() const;

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double expected_ = 0;  ///< grain-steps per cycle, summed over the packings not yet done
    double done_ = 0;      ///< grain-steps
    double cycles_ = 0;
    int packings_ = 0;
};

}  // namespace vibrotrough::campaign
