#pragma once

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

    /// Number of whole cycles n.
    int cycles() const { return static_cast<int>(normal_force.size()); }
};

}  // namespace vibrotrough::measure
