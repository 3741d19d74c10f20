#pragma once

#include "core/atomic_file.hpp"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vibrotrough::measure {

/// What one packing's run wrote within the cycles: line i = 0, 1 ... is at step (i + 1) n / 100, so that line
/// 99 is the end of the first cycle. All values are of that instant but the forces, which are means over the
/// steps since the line before.
struct PhaseSeries {
    static constexpr int per_cycle = 100;  ///< lines per cycle

    std::vector<double> x, z, vx, vz;        ///< of the layer's centre of mass, m and m/s
    std::vector<double> trough_x, trough_z;  ///< m, displacement of the trough
    std::vector<double> normal_force;        ///< N, layer on trough, positive when pressing
    std::vector<double> tangential_force;    ///< N, layer on trough, along x
    std::vector<double> floor_force;  ///< N, the part of normal_force that the floor carries, not side walls
    std::vector<double> touching;     ///< grains (of clumps: spheres) whose lowest point is below the floor
    std::vector<double> touching_vx;  ///< m/s, sum of v_x over them
    std::vector<double> touching_spin;       ///< m/s, sum of omega_y R over them
    std::vector<double> clearance;           ///< m, between floor and lowest grain; negative: overlap
    std::vector<double> energy_translation;  ///< J
    std::vector<double> energy_rotation;     ///< J
    std::vector<double> overlap;             ///< m, largest of two grains; 0 without contact

    /// Number of lines.
    std::size_t lines() const { return x.size(); }
    /// Number of whole cycles.
    int cycles() const { return static_cast<int>(lines()) / per_cycle; }
};

/// Reads phases.csv as the deck writes it. A last line without its end is left out: the engine may be writing
/// it.
/// @param steps_per_cycle  a multiple of 100
/// @throws InputError naming file and line when a line is damaged or missing
/// @throws MissingError when there is no such file
PhaseSeries read_phases(std::filesystem::path const& path, int steps_per_cycle);

/// The same of a file that was read before. @throws InputError
PhaseSeries parse_phases(core::TextFile const& file, int steps_per_cycle);

/// The same with places along the trough that are the integral of the velocity: for rigid bodies, whose
/// places the engine does not unwrap. Trapezoids, so that what an impact moves within a hundredth of a cycle
/// is known to the part of it that the impact is away from the middle.
/// @param interval  s, between two lines
PhaseSeries with_integrated_places(PhaseSeries series, double interval);

}  // namespace vibrotrough::measure
