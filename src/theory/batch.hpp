#pragma once

#include "theory/map.hpp"

#include <vector>

namespace vibrotrough::theory {

/// The answers to many points.
struct BatchAnswer {
    std::vector<MapPoint> points;     ///< in the order of the inputs
    double cpu_seconds_per_solution;  ///< CPU time of all threads over the number of points, s
};

/// Solves many unrelated points, each as solve_inputs() does, on `jobs` threads (0: all cores).
/// @throws std::invalid_argument naming the first point (from 1) whose inputs are not complete or out of
/// range; PhaseError when a point cannot be solved
BatchAnswer solve_batch(std::vector<Inputs> const& inputs, int jobs);

}  // namespace vibrotrough::theory
