#pragma once

#include "theory/map.hpp"

#include <vector>

namespace vibrotrough::theory {

/// The solutions of a batch.
struct BatchResult {
    std::vector<MapPoint> points;     ///< in the order of the inputs
    double cpu_seconds_per_solution;  ///< CPU time of all threads over the number of points, s
};

/// Solves many independent points, each with a PointSolver, on `jobs` threads (0: all cores).
/// @throws std::invalid_argument naming the first point (counted from 1) whose inputs are incomplete or out
/// of range, or a constant of the law is; PhaseError when a point cannot be solved
BatchResult solve_batch(std::vector<Inputs> const& inputs, int jobs,
                        std::optional<RollingLaw> const& rolling = {});

}  // namespace vibrotrough::theory
