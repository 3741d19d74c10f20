#pragma once

#include <chrono>

namespace vibrotrough::campaign {

/// Estimates how long the rest of a campaign takes, from the work done so far and how fast it went. Work is
/// counted in grain-steps of a small layer (prepare::PreparedCase::work).
class RemainingTime {
  public:
    void expect(double work);  ///< so much more is to be done than was known; negative: less
    void done(double work);    ///< a packing has ended that took so much

    double elapsed() const;  ///< s since the start

    /// @param under_way  work done by the packings that run now
    /// @return s, negative while nothing is known
    double seconds(double under_way) const;

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double expected_ = 0;  ///< work of the packings that are not done
    double done_ = 0;      ///< work
};

}  // namespace vibrotrough::campaign
