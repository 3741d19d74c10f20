#include "scenario/reader/sample_cube.hpp"

#include <numeric>
#include <utility>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/sobol.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>

namespace vibrotrough::scenario {
namespace {

// Boost's distributions give the same numbers on every machine; those of the standard library may differ.
using Random = boost::random::mt19937_64;

double uniform(Random& random) {
    return boost::random::uniform_01<double>()(random);
}

std::vector<std::vector<double>> sobol(int count, int dimensions, Random& random) {
    std::vector<double> shift;
    for (int k = 0; k < dimensions; ++k) shift.push_back(uniform(random));
    boost::random::sobol sequence(static_cast<std::size_t>(dimensions));
    boost::random::uniform_01<double> unit;
    std::vector<std::vector<double>> points(static_cast<std::size_t>(count));
    for (auto& point : points) {
        for (double const turn : shift) {
            double const turned = unit(sequence) + turn;
            point.push_back(turned < 1 ? turned : turned - 1);
        }
    }
    return points;
}

std::vector<std::vector<double>> latin_hypercube(int count, int dimensions, Random& random) {
    std::vector<std::vector<double>> points(static_cast<std::size_t>(count));
    for (int k = 0; k < dimensions; ++k) {
        std::vector<int> slices(points.size());
        std::iota(slices.begin(), slices.end(), 0);
        for (int i = count - 1; i > 0; --i) {  // Fisher and Yates
            int const other = boost::random::uniform_int_distribution<int>(0, i)(random);
            std::swap(slices[static_cast<std::size_t>(i)], slices[static_cast<std::size_t>(other)]);
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i].push_back((slices[i] + uniform(random)) / count);
        }
    }
    return points;
}

}  // namespace

std::vector<std::vector<double>> sample_cube(SampleMethod method, int count, int dimensions, unsigned seed) {
    Random random(seed);
    return method == SampleMethod::sobol ? sobol(count, dimensions, random)
                                         : latin_hypercube(count, dimensions, random);
}

}  // namespace vibrotrough::scenario
