#pragma once

#include "theory/coexisting.hpp"
#include "theory/map.hpp"

#include <vector>

namespace vibrotrough::theory {

/// The solutions of a batch.
struct BatchResult {
    std::vector<Efficiency> points;                      ///< in the order of the inputs
    std::vector<std::vector<CoexistingMotion>> motions;  ///< of each point; empty when not asked for
    double cpu_seconds_per_solution;  ///< CPU time of all threads over the number of points, s
};

/// Solves many independent points, each with a PointSolver, on `jobs` threads (0: all cores). A point whose
/// phases cannot be solved gets NaN.
/// @param first  number of the first point in messages, where a batch is solved in parts
/// @param starts  for a MotionSurvey of each point; 0: none
/// @throws std::invalid_argument naming the first point whose inputs are incomplete or out of range, or a
/// constant of the law is
BatchResult solve_batch(std::vector<Inputs> const& inputs, int jobs,
                        std::optional<RollingLaw> const& rolling = {}, std::size_t first = 1, int starts = 0);

}  // namespace vibrotrough::theory
