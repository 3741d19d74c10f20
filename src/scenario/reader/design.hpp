#pragma once

#include "scenario/reader/case_values.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::scenario {

/// A list of points: values of some keys that belong together. A swept key is one with a single column;
/// zipped lists, explicit points, a CSV file and a sample have several. A campaign runs the Cartesian product
/// of all its lists.
struct PointList {
    std::vector<std::string> keys;
    std::vector<std::vector<Value>> points;  ///< a row per point, a value per key
    Position where;
};

/// A condition on one key: all bounds that are set must hold.
struct Condition {
    std::string key;
    std::optional<double> above, below;  ///< SI
    std::optional<Content> equals;
    Position where;
};

/// Cases for which all conditions hold are left out.
using Exclusion = std::vector<Condition>;

/// The value that a case has for a key, whether it was given or follows from others (the throw number of a
/// drive whose frequency was given, the grains of a layer whose height was).
Content value_of(Scenario const& scenario, CaseValues const& given, std::string_view key);

/// Whether one of the exclusions leaves the case out.
bool is_excluded(Scenario const& scenario, CaseValues const& given, std::vector<Exclusion> const& exclusions);

/// Points that fill a cube [0, 1)^dimensions evenly.
enum class SampleMethod {
    sobol,            ///< Sobol's sequence, each dimension turned by a random shift (Cranley and Patterson)
    latin_hypercube,  ///< each of `count` slices of each dimension holds one point, at a random place in it
};

/// @param count       1 to 100000
/// @param dimensions  1 to 40
/// @return `count` rows of `dimensions` numbers; the same seed always gives the same ones
std::vector<std::vector<double>> sample_cube(SampleMethod method, int count, int dimensions, unsigned seed);

}  // namespace vibrotrough::scenario
