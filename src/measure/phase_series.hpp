#pragma once

#include "core/atomic_file.hpp"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vibrotrough::measure {

/// The results that the run of one packing wrote within the cycles. Line i = 0, 1 ... is at step (i + 1) n /
/// 100 with n steps per cycle, so that line 99 is the end of the first cycle. All values are instantaneous
/// except the forces, which are means over the steps since the previous line.
struct PhaseSeries {
    static constexpr int per_cycle = 100;  ///< lines per cycle

    std::vector<double> x, z, vx, vz;        ///< m and m/s, of the centre of mass of the layer
    std::vector<double> trough_x, trough_z;  ///< m, displacement of the trough
    std::vector<double> normal_force;        ///< N, of the layer on the trough, positive when pressing
    std::vector<double> tangential_force;    ///< N, of the layer on the trough, along x
    std::vector<double> floor_force;  ///< N, the part of normal_force on the floor, without the side walls
    /// Number of grains (or spheres of clumps) whose lowest point is below the floor surface.
    std::vector<double> touching;
    std::vector<double> touching_vx;    ///< m/s, sum of v_x over these grains
    std::vector<double> touching_spin;  ///< m/s, sum of omega_y R over these grains
    std::vector<double> clearance;  ///< m, between the floor and the lowest grain; negative if they overlap
    std::vector<double> energy_translation;  ///< J
    std::vector<double> energy_rotation;     ///< J
    std::vector<double> overlap;             ///< m, largest overlap of two grains; 0 without contacts

    /// Number of lines.
    std::size_t lines() const { return x.size(); }
    /// Number of whole cycles.
    int cycles() const { return static_cast<int>(lines()) / per_cycle; }
};

/// Reads phases.csv as written by the deck. A last line without a line end is left out, because the engine
/// may still be writing it.
/// @param steps_per_cycle  a multiple of 100
/// @throws InputError naming file and line when a line is damaged or missing
/// @throws MissingError if the file does not exist
PhaseSeries read_phases(std::filesystem::path const& path, int steps_per_cycle);

/// The same for a file that has already been read. @throws InputError
PhaseSeries parse_phases(core::TextFile const& file, int steps_per_cycle);

/// Replaces the positions along the trough by the integral of the velocity, for rigid bodies whose positions
/// the engine does not unwrap at periodic boundaries. The trapezoidal rule assumes that an impact occurs in
/// the middle of an interval of a hundredth of a cycle, which limits the accuracy of the displacement in that
/// interval.
/// @param interval  s, between two lines
PhaseSeries with_integrated_positions(PhaseSeries series, double interval);

}  // namespace vibrotrough::measure
