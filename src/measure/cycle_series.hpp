#pragma once

#include <filesystem>
#include <vector>

namespace vibrotrough::measure {

/// What one packing's run wrote, cycle by cycle. The floor is back at its place at every cycle's end, so the
/// displacement of the centre of mass is the displacement relative to the trough.
struct CycleSeries {
    std::vector<double> x;  ///< m, centre of mass along the trough at the end of cycle 0 ... n (n + 1 values)
    std::vector<double> z;  ///< m, centre of mass above the resting floor, as `x` (n + 1 values)
    std::vector<double>
        normal_force;  ///< N, layer on trough, mean over cycle 1 ... n, positive when pressing
    std::vector<double> tangential_force;  ///< N, layer on trough along x, as above
    std::vector<double>
        flight_fraction;  ///< fraction of the steps of cycle 1 ... n without contact with the trough

    std::vector<double>
        mean_velocity;  ///< m/s, of the centre of mass along the trough, mean over cycle 1 ... n

    /// Number of whole cycles n.
    int cycles() const { return static_cast<int>(normal_force.size()); }
};

/// Reads cycles.csv as the deck writes it. A last line without its end is left out: the engine may be writing
/// it.
/// @throws InputError naming file and line when a line is damaged, a cycle is missing or the grains are not
/// all there
/// @throws MissingError when there is no such file
CycleSeries read_cycles(std::filesystem::path const& path, int steps_per_cycle, int grains);

/// The first `cycles` cycles of a series that has at least as many.
CycleSeries first_cycles(CycleSeries const& series, int cycles);

/// Mean force of the layer on the trough over the last `cycles` cycles, N, pressing positive.
double mean_normal_force(CycleSeries const& series, int cycles);

}  // namespace vibrotrough::measure
