#include "measure/granular_temperature.hpp"

#include <algorithm>
#include <cstddef>

namespace vibrotrough::measure {
namespace {

/// Grains of a slab and the sums of their velocities.
struct SlabMotion {
    double grains = 0, x = 0, z = 0;
};

/// Sums over the slabs of a snapshot.
struct MeanMotion {
    double grains = 0;   ///< N
    double slabs = 0;    ///< B
    double squares = 0;  ///< m^2/s^2, sum of n (u_x^2 + u_z^2)
};

MeanMotion mean_motion(Snapshot const& snapshot, int bins_per_slab) {
    std::vector<SlabMotion> slabs(snapshot.bins.size() / static_cast<std::size_t>(bins_per_slab) + 1);
    for (std::size_t i = 0; i < snapshot.bins.size(); ++i) {
        Bin const& bin = snapshot.bins[i];
        SlabMotion& slab = slabs[i / static_cast<std::size_t>(bins_per_slab)];
        slab.grains += bin.grains;
        slab.x += bin.grains * bin.means[0];
        slab.z += bin.grains * bin.means[1];
    }
    MeanMotion all;
    for (SlabMotion const& slab : slabs) {
        if (!(slab.grains > 0)) continue;
        all.grains += slab.grains;
        all.slabs += 1;
        all.squares += (slab.x * slab.x + slab.z * slab.z) / slab.grains;
    }
    return all;
}

}  // namespace

std::optional<double> granular_temperature(std::vector<Snapshot> const& snapshots, PhaseSeries const& phases,
                                           TemperatureFacts const& facts) {
    double squares = 0, freedom = 0;
    long const n = facts.steps_per_cycle, lines = PhaseSeries::per_cycle;
    for (Snapshot const& one : snapshots) {
        if (one.step <= facts.discarded * n || one.step > facts.used * n) continue;
        auto const line = static_cast<std::size_t>(one.step * lines / n - 1);
        if (line >= phases.lines()) continue;
        MeanMotion const mean = mean_motion(one, facts.bins_per_slab);
        squares += 2 * phases.energy_translation[line] / facts.mass * mean.grains - mean.squares;
        freedom += 3 * mean.grains - 2 * mean.slabs;
    }
    if (!(freedom > 0)) return {};
    return std::max(0.0, squares) / freedom;
}

}  // namespace vibrotrough::measure
