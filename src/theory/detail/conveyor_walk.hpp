#pragma once

#include "theory/detail/conveyor_model.hpp"

#include <vector>

// Internal to the room.
namespace vibrotrough::theory::detail {

/// Where a motion is.
struct WalkState {
    double t = 0;
    bool flying = false;
    double gap = 0, gap_rate = 0;      ///< of a flight
    double v = 0;                      ///< slip velocity
    double slope = 1;                  ///< d v / d v at the start of the walk
    double starting = 0;               ///< +1, -1: a slide starts here from rest
    bool landed = false;               ///< the contact phase that comes now starts with a landing
    PhaseKind kind = PhaseKind::rest;  ///< of the slide under way
};

/// What a walk passed.
struct Passage {
    std::vector<Piece> pieces;
    std::vector<Impact> impacts;
    double displacement = 0;
    bool stopped = false;  ///< the slip velocity was zero at least once
};

/// Follows the motion of a model event by event.
class Walk {
  public:
    enum class Keep { nothing, pieces };

    explicit Walk(ConveyorModel const& model) : model_(model) {}
    /// Advances the state to time `end`; what it passed is added to `passage`.
    void advance(WalkState& s, double end, Passage& passage, Keep keep) const;

  private:
    void fly(WalkState& s, double end, Passage& passage, Keep keep) const;
    void land(WalkState& s, double approach, Passage& passage, Keep keep) const;
    void stick(WalkState& s, double end, Passage& passage, Keep keep) const;
    void slide(WalkState& s, double end, Passage& passage, Keep keep) const;
    void take_off(WalkState& s) const;

    ConveyorModel const& model_;
};

}  // namespace vibrotrough::theory::detail
