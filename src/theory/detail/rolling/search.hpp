#pragma once

#include "theory/detail/rolling/walk.hpp"

// The motion of a rolling layer that repeats. Internal to this room.
namespace vibrotrough::theory::detail {

/// Looks for the state that repeats, by Broyden's method on the change of the state over a period.
///
/// Friction and torque only bring states closer together, so that plain periods converge, too. The method
/// starts as plain periods do, and starts anew when its steps grow although the change does not.
class BroydenSearch {
  public:
    /// The next state to try, after one that changes by `change` over a period.
    RollingState propose(RollingState s, RollingState change);
    /// The distance to the state that repeats, as far as it is known after propose().
    double distance() const;

  private:
    void update(RollingState y);

    double a_ = -1, b_ = 0, c_ = 0, d_ = -1;  // inverse Jacobian, by rows
    RollingState step_{}, change_{};
    double last_ = 0;
    bool known_ = false;
};

/// Finds the state that repeats for one layer after another.
///
/// Newton's method with the exact derivative of a period takes three periods or so from the states of the
/// last layers. Where it does not settle, Broyden's method does.
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
