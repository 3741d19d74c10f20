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

/// A sphere of this radius (m) on the trough: R* = R and m* = m.
ContactPair grain_on_trough(scenario::Grains const& grains, double radius);

/// E* = E / (2 (1 - nu^2)), Pa: both bodies are of the grains' material.
double effective_modulus(scenario::Grains const& grains);

/// Stiffness of the spring of `contact = "hooke"`, N/m: k = 16/15 E* sqrt(R*) (15 m* v^2 / (16 E*
/// sqrt(R*)))^(1/5) (LIGGGHTS, gran model hooke, with v as its characteristicVelocity). It follows from equal
/// energies at equal overlap: m* v^2 / 2 = 8/15 E* sqrt(R*) d^(5/2) for Hertz (Johnson, Contact Mechanics,
/// 1985, section 11.4), = k d^2 / 2 for the spring. An impact with the speed v thus has the same largest
/// overlap with either.
double hooke_stiffness(scenario::Grains const& grains, ContactPair const& pair, double speed);

/// Damping over critical damping that belongs to a nominal restitution: z = |ln e| / sqrt(pi^2 + ln^2 e), so
/// that the whole half oscillation would give e.
double damping_ratio(double restitution);

/// An impact on a damped linear spring without attraction.
struct LinearImpact {
    double duration;     ///< s, until the force ends
    double restitution;  ///< speed at that moment over speed before
};

/// The impact with the force F = max(0, k d + c d'), c = 2 z sqrt(k m*). The overlap d = v / w exp(-z w0 t)
/// sin(w t) with w0 = sqrt(k / m*), w = w0 sqrt(1 - z^2) has no force any more when d'' = 0:
/// w t = pi - 2 asin(z) = 2 acos(z) and e = exp(-z w0 t) (Schwager & Poeschel, Granular Matter 9, 2007,
/// 465). Neither depends on the speed.
LinearImpact linear_impact(double stiffness, double mass, double damping_ratio);

/// Attraction of the model sjkr per overlap, N/m: 2 pi R* times the energy density. The area of contact is
/// that of the circle in which the spheres cut each other, 2 pi R* d for small overlaps d (LIGGGHTS, cohesion
/// sjkr).
double attraction_per_overlap(double cohesion, ContactPair const& pair);

/// The pull that separates a Hertz contact with the attraction of sjkr, N. The net force 4/3 E* sqrt(R*)
/// d^(3/2) - 2 pi R* w d, with the energy density w, is least at sqrt(d) = pi w sqrt(R*) / E*:
/// F = (2 pi^3 / 3) w^3 R*^2 / E*^2.
double pull_off_force(scenario::Grains const& grains, double cohesion, ContactPair const& pair);

/// The contact model of a case: its answers to all that is asked of one before a case runs. A third model is
/// a class here, a word of `engine.contact`, and its lines in input_templates/contact.mustache.
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
