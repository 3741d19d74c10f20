#pragma once

#include "scenario/model/scenario.hpp"

#include <optional>
#include <span>

/// @file
/// How stiff the grains of a layer must be. Simulated grains are softer than real ones, because the time step
/// grows with E^(-1/2). What this costs is the subject of validation/deep_layers.

namespace vibrotrough::scenario {

/// The angle by which the trough moves on while its landing crosses the layer, rad: s = omega h / c.
///
/// c = (E* / rho)^(1/3) (p / rho)^(1/6) is the speed of a compression wave in Hertz contacts under the
/// pressure p (Johnson, Contact Mechanics, 1985, for a chain of contacts; factors near 1 are left out), with
/// E* = E / (2 (1 - nu^2)), the density rho of the grains, and half the depth h pressed by gravity and the
/// trough's largest acceleration: p = phi rho h g cos(alpha) (1 + Gamma) / 2, phi = settled_solid_fraction.
/// @param modulus  E, Pa
double wave_number(Scenario const& scenario, double modulus);

/// The lowest modulus of the series 1, 1.5, 2, 3, 5, 7, 10, ... MPa whose wave_number() is at most `limit` in
/// all stages of the drive, Pa; at least 2 MPa.
double stiff_enough(Scenario const& scenario, double limit);

/// Gives the grains of all cases that have no modulus the same one, which is stiff_enough() for each of them
/// by its solver.softness, so that cases can be compared and share their settled packings. The contact of a
/// block has a stiffness of its own.
void choose_modulus(std::span<Scenario> cases);

/// Gives the grains a modulus (Pa) that was chosen, if there is one and they have none.
void give_modulus(Scenario& scenario, std::optional<double> modulus);

}  // namespace vibrotrough::scenario
