#pragma once

#include <chrono>

namespace vibrotrough::campaign {

/// Estimates how long the rest of a campaign takes, from the grain-steps done so far and how fast they went.
class RemainingTime {
  public:
    void expect(double grain_steps);  ///< so much more is to be done than was known; negative: less
    void done(double grain_steps);    ///< a packing has ended that took so much

    double elapsed() const;  ///< s since the start

    /// @param under_way  grain-steps done by the packings that run now
    /// @return s, negative while nothing is known
    double seconds(double under_way) const;

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double expected_ = 0;  ///< grain-steps of the packings that are not done
    double done_ = 0;      ///< grain-steps
};

}  // namespace vibrotrough::campaign
