#pragma once

#include "theory/detail/rolling/walk.hpp"

// The motion of a rolling layer that repeats. Internal to this module.
namespace vibrotrough::theory::detail {

/// Finds the state that repeats for one layer after another.
///
/// Newton's method takes three periods or so from the states of the last layers. Where it does not settle,
/// some plain periods come before its next attempt: friction and torque only bring states closer together.
class RollingSearch {
  public:
    /// Follows the layer until its state repeats. @param record  what it does in the last period
    /// @return whether the state repeats
    bool settle(RollingWalk const& walk, RollingNormal const& normal, RollingWalk::Record& record);

    /// Begins at rest, which for layers that have little in common is a better guess than the last states.
    void forget() { state_ = before_ = {}; }

  private:
    bool newton(RollingWalk const& walk, RollingNormal const& normal, RollingState& s, double most,
                RollingWalk::Record& record) const;

    RollingState state_{}, before_{};  // at the start of the period, for the last two layers
};

}  // namespace vibrotrough::theory::detail
