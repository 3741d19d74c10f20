#pragma once

namespace vibrotrough::engine {

/// A sphere and a flat wall of the same elastic material. SI units.
struct ContactMaterial {
    double radius;          ///< m
    double density;         ///< kg/m^3
    double youngs_modulus;  ///< Pa
    double poisson_ratio;   ///< dimensionless
    double restitution;     ///< nominal restitution coefficient
    double friction;        ///< coefficient of the sphere on the wall
};

/// Velocities at the end of an impact.
struct ImpactResult {
    double normal_speed;      ///< m/s, away from the wall, never negative
    double tangential_speed;  ///< m/s, of the centre
    double spin;              ///< rad/s, positive in the sense of rolling along the tangential velocity
};

/// The impact of a sphere without spin on a wall, by the contact law that the decks use, integrated without
/// the engine.
///
/// Normal force F = max(0, 4/3 E* sqrt(R d) d + 2 sqrt(5/6) |b| sqrt(2 E* sqrt(R d) m) d'), with overlap d
/// and b = ln(e) / sqrt(ln(e)^2 + pi^2) (Tsuji, Tanaka & Ishida, Powder Technology 71, 1992, as `hertz` with
/// `limitForce on`). Tangential force: a spring of stiffness 8 G* sqrt(R d) whose force is limited to
/// friction times F, without damping (`tangential history`, `tangential_damping off`); its lever arm is R -
/// d/2.
/// @param normal_speed      m/s, towards the wall, positive
/// @param tangential_speed  m/s
ImpactResult integrate_impact(ContactMaterial const& material, double normal_speed, double tangential_speed);

double effective_modulus(ContactMaterial const& material);  ///< E* = E / (2 (1 - nu^2)), Pa
double effective_shear(ContactMaterial const& material);    ///< G* = E / (4 (2 - nu) (1 + nu)), Pa
double sphere_mass(ContactMaterial const& material);        ///< kg
}  // namespace vibrotrough::engine
