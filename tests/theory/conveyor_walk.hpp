#pragma once

#include "conveyor_model.hpp"

#include <vector>

namespace vibrotrough::theory {

/// A ConveyorModel with the end of each phase, found in steps that cannot skip a zero.
class WalkModel : public ConveyorModel {
  public:
    explicit WalkModel(Conveyor const& conveyor);

    double trough_vx_bound() const { return vx_bound_; }  ///< it is never faster
    double landing_tangent() const { return landing_; }   ///< mu of landings times tan(beta)
    /// The acceleration of a slide in direction sign (+1, -1) at zero slip speed; it starts if this is
    /// positive.
    double slide_drive(double sign, double t) const {
        Shifted const& drive = sign > 0 ? drive_positive_ : drive_negative_;
        return drive.constant + drive.sum(t);
    }
    /// The margin of static friction against a slide in direction sign; negative when the mass starts to
    /// slide.
    double hold(double sign, double t) const {
        Shifted const& hold = sign > 0 ? hold_positive_ : hold_negative_;
        return hold.constant + hold.sum(t);
    }
    double take_off_after(double t, double end) const;
    double slip_after(double sign, double t, double end) const;
    double stop_after(double sign, double t, double speed, double end) const;
    double landing_after(double t, double gap, double gap_rate, double end) const;

  private:
    struct Shifted {
        double constant = 0;
        Trigonometric sum;
    };
    Trigonometric normal_, needed_;
    Shifted hold_positive_, hold_negative_, drive_positive_, drive_negative_;
    double landing_, vx_bound_, normal_bend_, hold_bend_, fall_bound_;
};

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

    explicit Walk(WalkModel const& model) : model_(model) {}
    /// Advances the state to time `end` and adds what happened to `passage`.
    void advance(WalkState& s, double end, Passage& passage, Keep keep) const;

  private:
    void fly(WalkState& s, double end, Passage& passage, Keep keep) const;
    void land(WalkState& s, double approach, Passage& passage, Keep keep) const;
    void stick(WalkState& s, double end, Passage& passage, Keep keep) const;
    void slide(WalkState& s, double end, Passage& passage, Keep keep) const;
    void take_off(WalkState& s) const;

    WalkModel const& model_;
};

}  // namespace vibrotrough::theory
