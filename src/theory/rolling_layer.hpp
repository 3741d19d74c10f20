#pragma once

#include "theory/point_mass.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::theory {

/// The constants of the rolling-layer law, and where the layer lands. The defaults are the published ones;
/// their intervals are in validation/rolling_layer.
///
/// Lengths are in r cos(beta) along the trough and in r sin(beta) normal to it, time is in 1/omega.
struct RollingLaw {
    double torque = 0.61;        ///< c, viscous internal torque per spin, in [1e-6, 1e6] or infinite
    double dry_torque = 0.02;    ///< mu_i, dry internal torque over the normal force, in [0, 1e6]
    double spin_inertia = 0.10;  ///< I, inertia of the spin of the floor grains over that of the layer's
                                 ///< translation, in [1e-6, 1e3]
    double stiffness = 14;       ///< kappa of the landing, in [2, 1e3]; infinite: a rigid plastic landing
    double damping = 2.2;        ///< zeta of the landing, in [1.01, 100]
};

/// The law of grains with a rolling friction (a coefficient, >= 0), which adds to its dry torque
/// (validation/atlas, up to 0.2).
RollingLaw law_of_grains(double rolling_friction);

inline constexpr double rigid = std::numeric_limits<double>::infinity();  ///< A stiffness without limit.

/// Sets the constant that is called `name`: torque, dry_torque, spin_inertia, stiffness or damping.
/// @return whether there is such a constant
bool set_constant(RollingLaw& law, std::string_view name, double value);

/// The names of the constants in the order of RollingLaw.
std::vector<std::string_view> const& rolling_constants();

/// A layer of grains that roll on the trough, as a rolling bed under a rigid layer.
struct RollingLayer {
    PointMass point;  ///< drive, inclination and friction, as for the point mass
    RollingLaw law;   ///< constants of the law
};

/// The state of a rolling layer at one time; velocities are in omega r cos(beta).
struct RollingSample {
    double t;             ///< rad
    PhaseKind kind;       ///< what the layer does; F as soon as the trough exerts no force
    double velocity;      ///< of the layer along the trough, relative to it
    double spin;          ///< surface velocity of the spinning floor grains, positive when rolling forwards
    double gap;           ///< height above the trough, r sin(beta); negative in a soft landing
    double gap_rate;      ///< its rate, omega r sin(beta)
    double normal_force;  ///< per mass, omega^2 r sin(beta); impulses of a rigid landing not included
    double tangential_force;  ///< per mass, omega^2 r cos(beta); positive forwards
};

class RollingPeriod;  // one period with all that is needed to evaluate it; see detail/rolling_walk.hpp

/// The long run of a rolling layer.
struct RollingMotion {
    Motion
        motion;  ///< as for a PointMass; slides are those of the layer, whether its floor grains roll or slip
    std::shared_ptr<RollingPeriod const> period;  ///< nothing when there is no period
};

/// Solves for the periodic motion of a rolling layer, in closed form within each phase.
///
/// Model (a candidate; validation/rolling_layer says what it predicts and what it does not). With u the
/// velocity of the layer, v = u - cos t, w the surface velocity of the spinning floor grains, s = v - w the
/// slip at the floor and N = n tan(beta) for the normal force n:
/// - along: u' = -tan(alpha) tan(beta) / Gamma + F with |F| <= mu N and s F < 0, or s = 0;
/// - spin: I w' = -F - c w - mu_i N sign(w), in flight without F and N;
/// - normal: y'' = -1/Gamma + sin t + n, n = max(0, -kappa^2 y - 2 zeta kappa y') for y < 0.
///
/// The equations are linear within a phase (sliding or rolling, each with one sign of the spin, rest and
/// flight). With an infinite torque, or mu_i >= mu, the spin is zero, and with a rigid landing the motion is
/// then that of solve(PointMass) to 1e-9. (A rigid landing is an impulse, which spins the grains up however
/// large a finite torque is.)
///
/// @throws std::invalid_argument when an input or constant is out of range
/// @throws PhaseError when a phase cannot be solved
RollingMotion solve(RollingLayer const& layer);

/// The motion at `count` >= 2 equally spaced times over its period, both ends included.
/// @throws std::invalid_argument when the motion has no period
std::vector<RollingSample> trace(RollingMotion const& motion, int count);

/// Solves many rolling layers one after another and reuses the normal motion of the last throw number. Use
/// one solver per thread.
class RollingLayerSolver {
  public:
    /// @throws std::invalid_argument when a constant is out of range
    explicit RollingLayerSolver(RollingLaw const& law);
    ~RollingLayerSolver();
    /// Moves the memory of earlier points.
    RollingLayerSolver(RollingLayerSolver&&) noexcept;
    /// Moves the memory of earlier points.
    RollingLayerSolver& operator=(RollingLayerSolver&&) noexcept;

    /// As solve(). @throws std::invalid_argument, PhaseError as solve() does
    RollingMotion operator()(PointMass const& point);

  private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

}  // namespace vibrotrough::theory
