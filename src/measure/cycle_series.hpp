#pragma once

#include "core/atomic_file.hpp"

#include <filesystem>
#include <vector>

namespace vibrotrough::measure {

/// What one packing's run wrote, cycle by cycle. The floor is back at its place at every cycle's end, so the
/// displacement of the centre of mass is the displacement relative to the trough.
struct CycleSeries {
    // Centre of mass at the end of cycle 0 ... n (n + 1 values).
    std::vector<double> x;   ///< m, along the trough
    std::vector<double> z;   ///< m, above the resting floor
    std::vector<double> vz;  ///< m/s, normal to the trough
    // Means over the steps of cycle 1 ... n.
    std::vector<double> mean_velocity;     ///< m/s, of the centre of mass along the trough
    std::vector<double> normal_force;      ///< N, layer on trough, positive when pressing
    std::vector<double> tangential_force;  ///< N, layer on trough, along x
    std::vector<double> flight_fraction;   ///< fraction of the steps without contact with the trough

    /// Number of whole cycles n.
    int cycles() const { return static_cast<int>(normal_force.size()); }
};

/// Reads cycles.csv as the deck writes it. A last line without its end is left out: the engine may be writing
/// it.
/// @throws InputError naming file and line when a line is damaged, a cycle is missing or grains are
/// @throws MissingError when there is no such file
CycleSeries read_cycles(std::filesystem::path const& path, int steps_per_cycle, int grains);

/// The same of a file that was read before. @throws InputError
CycleSeries parse_cycles(core::TextFile const& file, int steps_per_cycle, int grains);

/// The first `cycles` cycles of a series that has at least as many.
CycleSeries first_cycles(CycleSeries const& series, int cycles);

/// The layer's weight by the balance of momentum over all cycles, N: what the trough carried on average, less
/// the momentum that the layer gained, W = mean(F_z) - m (v_z(n) - v_z(0)) / (n T). Exact up to the
/// integrator, so it shows whether the trough weighed every force that moved the layer, and no other force
/// did.
/// @param mass    kg, of the layer
/// @param period  s, of a cycle
double weight_by_momentum(CycleSeries const& series, double mass, double period);

}  // namespace vibrotrough::measure
