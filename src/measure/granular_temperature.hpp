#pragma once

#include "measure/layer_profiles.hpp"
#include "measure/phase_series.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::measure {

/// What the granular temperature needs in addition to snapshots and phases.
struct TemperatureFacts {
    double mass;          ///< kg, of the layer
    int steps_per_cycle;  ///< time steps of the engine per cycle
    int discarded, used;  ///< cycles after number `discarded` up to number `used` count
    int bins_per_slab;    ///< so many bins of the snapshots are one mean diameter high
};

/// The granular temperature of a layer of one material, m^2/s^2: a third of the mean square of the grains'
/// velocities v relative to the mean velocity u of the slab of one diameter in which they are,
///
///     T = (sum of v^2 - sum over the slabs of n (u_x^2 + u_z^2)) / (3 N - 2 B).
///
/// The first sum is twice the kinetic energy of the grains' translation over the mass of one. The mean
/// velocity of a slab takes one of its n grains' freedom along x and one along z; B slabs have grains. Across
/// the trough the layer does not move as a whole.
/// @returns none when no snapshot counts
std::optional<double> granular_temperature(std::vector<Snapshot> const& snapshots, PhaseSeries const& phases,
                                           TemperatureFacts const& facts);

}  // namespace vibrotrough::measure
