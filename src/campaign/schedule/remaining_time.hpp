#pragma once

#include "prepare/prepared_case.hpp"

#include <chrono>

namespace vibrotrough::campaign {

/// Estimates how long the rest of a campaign takes, from the grain-steps done so far and how fast they went.
class RemainingTime {
  public:
    void expect(prepare::PreparedCase const& prepared);  ///< one more packing to run
    void drop(prepare::PreparedCase const& prepared);    ///< a packing that will not be run, or failed
    void done(prepare::PreparedCase const& prepared, int cycles);  ///< a packing that took this many cycles

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
