#pragma once

namespace vibrotrough::engine {

/// A sphere and a flat wall of the same elastic material. SI units.
struct ContactMaterial {
    double radius;          ///< m
    double density;         ///< kg/m^3
    double youngs_modulus;  ///< Pa
    double poisson_ratio;   ///< Poisson's ratio
    double restitution;     ///< nominal
    double friction;        ///< coefficient mu
};

/// Velocities at the end of an impact.
struct ImpactResult {
    double normal_speed;      ///< m/s, away from the wall, never negative
    double tangential_speed;  ///< m/s, of the centre
    double spin;              ///< rad/s, positive as in rolling along the tangential velocity
};

/// The contact law that our decks ask for, integrated without the engine: a sphere without spin hits a wall.
///
/// Normal force F = max(0, 4/3 E* sqrt(R d) d + 2 sqrt(5/6) |b| sqrt(2 E* sqrt(R d) m) d'), d the overlap,
/// b = ln(e) / sqrt(ln(e)^2 + pi^2) (Tsuji, Tanaka & Ishida, Powder Technology 71, 1992, as `hertz` with
/// `limitForce on`). Tangential force: a spring of stiffness 8 G* sqrt(R d) that is cut to friction times F
/// when it is longer, no damping (`tangential history`, `tangential_damping off`); its lever is R - d/2.
/// @param normal_speed      m/s, towards the wall, positive
/// @param tangential_speed  m/s
ImpactResult integrate_impact(ContactMaterial const& material, double normal_speed, double tangential_speed);

double effective_modulus(ContactMaterial const& material);            ///< E* = E / (2 (1 - nu^2)), Pa
double effective_shear(ContactMaterial const& material);              ///< G* = E / (4 (2 - nu) (1 + nu)), Pa
double sphere_mass(ContactMaterial const& material);                  ///< kg
double hertz_force(ContactMaterial const& material, double overlap);  ///< 4/3 E* sqrt(R) d^(3/2), N

/// Overlap at which the Hertz force is `force`, m.
double hertz_overlap(ContactMaterial const& material, double force);

}  // namespace vibrotrough::engine
