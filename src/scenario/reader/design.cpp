#include "scenario/reader/design.hpp"

#include "scenario/reader/swept_keys.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

bool is_same(Content const& value, Content const& wanted) {
    auto const* const number = std::get_if<double>(&value);
    auto const* const other = std::get_if<double>(&wanted);
    if (number == nullptr || other == nullptr) return value == wanted;
    return std::abs(*number - *other) <= 1e-9 * std::abs(*other);
}

bool holds(Condition const& condition, Content const& value) {
    double const* const number = std::get_if<double>(&value);
    return (!condition.above || (number != nullptr && *number > *condition.above)) &&
           (!condition.below || (number != nullptr && *number < *condition.below)) &&
           (!condition.equals || is_same(value, *condition.equals));
}

}  // namespace

double DomainAxis::at(double fraction) const {
    double const value = low + fraction * (high - low);
    return find_key(key)->kind == KeyKind::integer ? std::round(value) : value;
}

void set_value(CaseValues& values, std::string const& key, Value const& value) {
    Key const& known = *find_key(key);
    auto const before = values.find(known.path);
    std::string const unit = before == values.end() || !value.unit.empty() ? value.unit : before->second.unit;
    if (!known.group.empty()) {
        std::erase_if(values, [&](auto const& entry) { return find_key(entry.first)->group == known.group; });
    }
    values[known.path] = {value.content, value.where, unit};
}

std::optional<Content> value_of(Scenario const& scenario, CaseValues const& given, std::string_view key) {
    if (auto const found = given.find(key); found != given.end()) return found->second.content;
    return key_value(scenario, key);
}

bool is_excluded(Scenario const& scenario, CaseValues const& given,
                 std::vector<Exclusion> const& exclusions) {
    return std::ranges::any_of(exclusions, [&](Exclusion const& exclusion) {
        return std::ranges::all_of(exclusion, [&](Condition const& condition) {
            auto const value = value_of(scenario, given, condition.key);
            return value && holds(condition, *value);
        });
    });
}

std::vector<std::vector<double>> sample_cube(SampleMethod method, int count, int dimensions, unsigned seed) {
    Random random(seed);
    return method == SampleMethod::sobol ? sobol(count, dimensions, random)
                                         : latin_hypercube(count, dimensions, random);
}

}  // namespace vibrotrough::scenario
