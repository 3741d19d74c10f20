#pragma once

#include "scenario/model/scenario.hpp"

#include <memory>
#include <optional>
#include <string_view>

/// @file
/// Formulas of a single contact: what it takes to choose a time step and to check a case before it runs.

namespace vibrotrough::prepare {

/// Two bodies in contact, or a grain and the trough, which has neither curvature nor an end to its mass.
struct ContactPair {
    double radius;  ///< m, R* = R1 R2 / (R1 + R2)
    double mass;    ///< kg, m* = m1 m2 / (m1 + m2)
};

/// Two equal spheres of this radius (m) and of the grains' density: R* = R / 2 and m* = m / 2.
ContactPair two_grains(scenario::Grains const& grains, double radius);

/// E* = E / (2 (1 - nu^2)), Pa: both bodies are of the grains' material.
double effective_modulus(scenario::Grains const& grains);

/// Stiffness of the spring of `contact = "hooke"`, N/m: k = 16/15 E* sqrt(R*) (15 m* v^2 / (16 E*
/// sqrt(R*)))^(1/5) (LIGGGHTS, gran model hooke, with v as its characteristicVelocity). It follows from equal
/// energies at equal overlap: m* v^2 / 2 = 8/15 E* sqrt(R*) d^(5/2) for Hertz (Johnson, Contact Mechanics,
/// 1985, section 11.4), = k d^2 / 2 for the spring. An impact with the speed v thus has the same largest
/// overlap with either.
double hooke_stiffness(scenario::Grains const& grains, ContactPair const& pair, double speed);

/// Coefficient of restitution of an impact whose force never attracts, at the damping ratio z (damping over
/// critical damping, 0 to 1): e = exp(-2 z acos(z) / sqrt(1 - z^2)).
///
/// On a linear spring F = max(0, k d + c d'), c = 2 z sqrt(k m*), the overlap d = v / w exp(-z w0 t) sin(w t)
/// with w0 = sqrt(k / m*), w = w0 sqrt(1 - z^2) has no force any more when d'' = 0: w t = 2 acos(z)
/// (Schwager & Poeschel, Granular Matter 9, 2007, 465). The damped Hertz contact of LIGGGHTS, m* d'' = -K
/// d^(3/2) - sqrt(5 K m*) z d^(1/4) d', has the same e: with y = 2/sqrt(5) d^(5/4) it is the linear
/// oscillator v dv/dy = -y - 2 z v (in units of K and m*), and its force ends where y + 2 z v = 0, as there
/// (Antypov & Elliott, EPL 94, 2011, 50004). Neither depends on the speed.
double restitution_of(double damping_ratio);

/// The damping ratio with which an impact has this restitution, of least_restitution to 1.
double damping_ratio(double restitution);

/// The engine's coefficientRestitution for grains that really come back with this one:
/// exp(-pi z / sqrt(1 - z^2)), which is what a force that may attract would give. 0.3 needs 0.17, 0.5 needs
/// 0.44, 0.8 needs 0.79.
double nominal_restitution(double restitution);

/// The least that the engine can be asked for: it takes coefficients from 0.05 on. Critical damping gives
/// exp(-2) = 0.135.
inline constexpr double least_restitution = 0.2137;

/// Duration of an impact on a linear spring (N/m) that never attracts, s: 2 acos(z) / (w0 sqrt(1 - z^2)).
double linear_duration(double stiffness, double mass, double damping_ratio);

/// The contact model of a case: its answers to all that is asked of one before a case runs.
class Contact {
  public:
    virtual ~Contact() = default;
    /// Its name in comments of the deck, such as "Hertz".
    virtual std::string_view name() const = 0;
    /// Duration of an impact, s; attraction, which makes it longer, is left out. @param speed  m/s
    virtual double duration(ContactPair const& pair, double speed, double restitution) const = 0;
    /// The overlap under a force that presses (N), m: where spring, attraction and force balance; infinite
    /// when the attraction is larger than the spring.
    virtual double overlap_under(ContactPair const& pair, double force) const = 0;
    /// The largest overlap of an undamped impact, m: where the kinetic energy and the work of the attraction,
    /// pi R* w d^2, are in the spring. Damping makes it smaller. @param speed  m/s
    virtual double overlap_of_impact(ContactPair const& pair, double speed) const = 0;
    /// The pull that separates a contact, N; 0 where no pull is held, because spring and attraction are both
    /// proportional to the overlap.
    virtual double pull_off_force(ContactPair const& pair) const = 0;
    /// Attraction over the force of the spring, where both are proportional to the overlap; nothing
    /// elsewhere.
    virtual std::optional<double> attraction_ratio(ContactPair const& pair) const = 0;
    /// n, where the overlap at rest goes with Young's modulus as E^(-n): so must the energy density of the
    /// attraction go with E^n for the same attraction.
    virtual double stiffness_exponent() const = 0;
};

/// Of a scenario whose modulus is known. @param speed  m/s, for which a linear spring is chosen; see
/// hooke_stiffness()
std::unique_ptr<Contact const> contact_of(scenario::Scenario const& scenario, double speed);

}  // namespace vibrotrough::prepare
