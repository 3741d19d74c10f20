#pragma once

#include <vector>

namespace vibrotrough::scenario {

/// How points are chosen that fill the cube [0, 1)^dimensions evenly.
enum class SampleMethod {
    sobol,            ///< Sobol sequence, each dimension shifted at random (Cranley and Patterson, 1976)
    latin_hypercube,  ///< each of `count` slices of each dimension holds one point at a random position
};

/// Chooses points in the cube [0, 1)^dimensions.
/// @param count       number of points, 1 to 100000
/// @param dimensions  1 to 40
/// @param seed        the same seed always gives the same points
/// @return `count` rows of `dimensions` numbers
std::vector<std::vector<double>> sample_cube(SampleMethod method, int count, int dimensions, unsigned seed);

}  // namespace vibrotrough::scenario
