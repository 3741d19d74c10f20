#pragma once

#include "scenario/model/scenario.hpp"

/// @file
/// How stiff the grains of a layer must be. Simulated grains are softer than real ones, because the time step
/// grows with E^(-1/2). What this costs is the subject of validation/deep_layers.

namespace vibrotrough::prepare {

/// The angle by which the trough moves on while its landing crosses the layer, rad: s = omega h / c.
///
/// c = (E* / rho)^(1/3) (p / rho)^(1/6) is the speed of a compression wave in Hertz contacts under the
/// pressure p (Johnson, Contact Mechanics, 1985, for a chain of contacts; factors near 1 are left out), with
/// E* = E / (2 (1 - nu^2)), the density rho of the grains, and half the depth h pressed by gravity and the
/// trough's largest acceleration: p = phi rho h g cos(alpha) (1 + Gamma) / 2, phi = settled_solid_fraction.
/// @param modulus  E, Pa
double wave_number(scenario::Scenario const& scenario, double modulus);

/// Bound of the error of the velocity efficiency that soft grains of this modulus (Pa) cause, 4 s^2: nearly
/// all layers of validation/deep_layers (3 to 20 diameters, throw numbers 1.5 to 2.9) differ by less from the
/// same layer of stiff grains, and half of them by less than a quarter of it.
double softness_bound(scenario::Scenario const& scenario, double modulus);

/// Whether the grains of a case are too soft for what it asks: even the error of the layer in the middle, a
/// quarter of the bound, is more than half of measure.half_width. The modulus must be known.
bool is_soft(scenario::Scenario const& scenario);

/// The lowest modulus of the series 1, 1.5, 2, 3, 5, 7, 10, ... MPa whose softness_bound() is at most
/// `error`, Pa; at least 2 MPa. The steps of the series let cases of a campaign share their settled packings.
double stiff_enough(scenario::Scenario const& scenario, double error);

}  // namespace vibrotrough::prepare
