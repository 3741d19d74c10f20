#pragma once

#include "theory/detail/conveyor_model.hpp"

#include <vector>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// The state of a motion at one time.
struct WalkState {
    double t = 0;
    bool flying = false;
    double gap = 0, gap_rate = 0;      ///< height above the trough during a flight, and its rate
    double v = 0;                      ///< slip velocity
    double slope = 1;                  ///< derivative of v with respect to v at the start of the walk
    double starting = 0;               ///< +1, -1: a slide in this direction starts here from rest
    bool landed = false;               ///< whether the next contact phase starts with a landing
    PhaseKind kind = PhaseKind::rest;  ///< of the current slide
};

/// What happened during a walk.
struct Passage {
    std::vector<Piece> pieces;
    std::vector<Impact> impacts;
    double displacement = 0;
    int events = 0;        ///< ends of phases
    bool stopped = false;  ///< whether the slip velocity was zero at least once
};

/// Follows the motion of a model from event to event.
class Walk {
  public:
    enum class Keep { nothing, pieces };

    explicit Walk(ConveyorModel const& model) : model_(model) {}
    /// Advances the state to time `end` and adds what happened to `passage`.
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
