#pragma once

#include "theory/detail/common/first_zero.hpp"
#include "theory/detail/rolling/normal.hpp"
#include "theory/detail/rolling/relaxation.hpp"

#include <optional>
#include <vector>

// The motion of a rolling layer along the trough. Internal to this room.
namespace vibrotrough::theory {

/// A part of the motion with one set of linear equations.
struct RollingPhase {
    double start, end;             ///< rad
    int slip;                      ///< sign of the slip at the floor; 0: the floor grains roll, or all rests
    int turn;                      ///< sign of the spin; 0: no spin
    bool contact;                  ///< false in flight
    double velocity, spin;         ///< at the start: v and w
    detail::NormalPiece normal{};  ///< the part of the normal motion within which it lies
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
    /// The velocity of the layer within a phase, from its start.
    Relaxation velocity(RollingPhase const& phase) const;
    /// The spin within a phase.
    Relaxation spin(RollingPhase const& phase) const;
    /// The friction force within a phase. @param v, w  the state at t
    double friction_force(RollingPhase const& phase, double t) const;

  private:
    /// The contact force with its decays counted from the start of a phase, and its value there.
    struct Contact {
        ContactForce n;
        Instant start;
        double normal_force;  ///< N
    };
    RollingPhase next_phase(NormalPiece const& piece, Contact const& contact, RollingState s,
                            int leaving) const;
    RollingPhase from_no_slip(RollingPhase phase, Contact const& contact, int leaving) const;
    /// The velocities of a phase and the contact force.
    struct Forces {
        ContactForce n;
        Relaxation v, w;
        std::optional<PhaseSum> v_sum, w_sum;  ///< the same velocities; nothing for decays of equal rates
        PhaseBasis basis;
    };
    Forces forces(RollingPhase const& phase, Contact const& contact) const;
    struct Progress;
    void step(Progress& now, RollingPhase& phase, Contact const& contact, double end, Record* record) const;
    Relaxation velocity(RollingPhase const& phase, ContactForce const& n, Instant const& start) const;
    Relaxation spin(RollingPhase const& phase, ContactForce const& n, Instant const& start) const;
    double end_of(RollingPhase const& phase, Forces const& f, double end, int& what) const;
    /// The same for decays with about equal rates.
    double end_of_close_rates(RollingPhase const& phase, Forces const& f, double end, int& what) const;
    std::array<Sample, 3> without_slip(RollingPhase const& phase, ContactForce const& n, Relaxation const& w,
                                       double t) const;
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
