#pragma once

#include <optional>
#include <vector>

namespace vibrotrough::theory {

/// Forces on a mass in a part of a period, which are constant there. Any units that belong together.
struct PushedInterval {
    double needed;    ///< friction that a mass needs to rest on the trough, per mass: its acceleration less
                      ///< gravity's component along it
    double friction;  ///< the most that friction gives: mu times the normal force, per mass
};

/// The mean slip velocity of a mass in its periodic motion on a trough whose motion and normal force were
/// measured: it slides and rests as the point mass does (Eqs. 6-11).
/// @param period    of equally long intervals
/// @param duration  of one of them
/// @return no value when the mass runs away
std::optional<double> mean_slip(std::vector<PushedInterval> const& period, double duration);

}  // namespace vibrotrough::theory
