#pragma once

#include "theory/detail/rolling/normal.hpp"

#include <vector>

// The motion of a rolling layer along the trough. Internal to this module.
namespace vibrotrough::theory {

/// A part of the motion with one set of linear equations.
struct RollingPhase {
    double start, end;             ///< rad
    int slip;                      ///< sign of the slip at the floor; 0: the floor grains roll, or all rests
    int turn;                      ///< sign of the spin; 0: no spin
    bool contact;                  ///< false in flight
    double velocity, spin;         ///< at the start: v and w
    detail::NormalPiece normal{};  ///< the part of the normal motion within which it lies
    detail::PhaseBasis basis{};    ///< of the sums
    detail::PhaseSum v{}, w{}, n{};  ///< velocity, spin and normal force
};

/// One period of the motion along the trough.
class RollingPeriod {
  public:
    std::vector<RollingPhase> phases;  ///< in order
    RollingLayer layer{};              ///< whose motion this is
    double start = 0, end = 0;         ///< rad
};

namespace detail {

/// v and w at one time.
struct RollingState {
    double v = 0, w = 0;
};

/// How v and w at one time depend on the state before.
struct RollingSensitivity {
    RollingState v{1, 0};  ///< derivatives of v by the earlier v and w
    RollingState w{0, 1};  ///< and of w
    bool known = true;     ///< false behind a rigid landing
};

/// Follows the motion along the trough through the pieces of the normal motion.
class RollingWalk {
  public:
    explicit RollingWalk(RollingLayer const& layer);

    /// What the layer did in a period.
    struct Record {
        double travel = 0;                 ///< r cos(beta)
        std::vector<RollingPhase> phases;  ///< in order
    };
    /// The state after the pieces, from that before them.
    /// @param record  nothing when it is not needed; what it holds is replaced
    /// @param by  becomes how the state after depends on that before; nothing when it is not needed
    RollingState follow(RollingNormal const& normal, RollingState s, Record* record,
                        RollingSensitivity* by = nullptr) const;
    /// What neither |v| nor |w| exceeds in a motion that repeats after `length`.
    double greatest_velocity(double length) const;
    /// The friction force within a phase.
    double friction_force(RollingPhase const& phase, double t) const;

  private:
    /// Where a phase begins, and N there.
    struct Contact {
        Instant start;
        double normal_force;
    };
    RollingPhase next_phase(NormalPiece const& piece, Contact const& contact, RollingState s,
                            int leaving) const;
    RollingPhase from_no_slip(RollingPhase phase, Contact const& contact, int leaving) const;
    void solve(RollingPhase& phase, Instant const& start) const;
    PhaseSum needed_friction(RollingPhase const& phase) const;
    struct Progress;
    void step(Progress& now, RollingPhase& phase, Contact const& contact, double end, Record* record) const;
    double end_of(RollingPhase const& phase, double end, int& what) const;
    RollingState land(RollingState s, double impulse) const;
    RollingState rates(RollingPhase const& phase, double sine, double normal_force, RollingState s) const;
    void carry(RollingSensitivity& by, RollingPhase const& phase) const;
    void pass(RollingSensitivity& by, RollingPhase const& before, Progress const& now,
              RollingPhase const& after, Contact const& contact) const;

    double gravity_, tangent_, friction_, dry_, inertia_, torque_, weight_;
    bool no_spin_;
};

}  // namespace detail
}  // namespace vibrotrough::theory
