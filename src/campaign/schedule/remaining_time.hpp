#pragma once

#include <chrono>

namespace vibrotrough::campaign {

/// What packings have taken so far, s of the clock.
struct PackingTime {
    double settling = 0;  ///< before their trough moved
    double moving = 0;    ///< since then
    int settled = 0;      ///< packings that `settling` was enough for

    PackingTime& operator+=(PackingTime const& other);  ///< adds what other packings have taken
};

/// Estimates how long the rest of a campaign takes, from the work done so far and how fast it went. Work is
/// that on a moving trough, counted in grain-steps of a small layer (prepare::PreparedCase::work); packings
/// that have not started will also settle, for as long as the others did.
class RemainingTime {
  public:
    void expect(double work);  ///< so much more is to be done than was known; negative: less
    void done(double work, PackingTime const& taken = {});  ///< a packing has ended that took so much

    double elapsed() const;  ///< s since the start

    /// @param under_way    work done by the packings that run now
    /// @param running      what they have taken
    /// @param not_started  packings that will still settle
    /// @return s, negative while nothing is known
    double seconds(double under_way, PackingTime const& running = {}, int not_started = 0) const;

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double expected_ = 0;  ///< work of the packings that are not done
    double done_ = 0;      ///< work
    PackingTime taken_;    ///< by the packings that are done
};

}  // namespace vibrotrough::campaign
