#include "atlas/unknown.hpp"

#include "atlas/value.hpp"
#include "scenario/reader/sample_cube.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vibrotrough::atlas {

double middle_of(Input input) {
    return (inputs()[input].low + inputs()[input].high) / 2;
}

double sd_of_unknown(std::span<Input const> unknown, std::optional<std::pair<Input, double>> const& fixed) {
    constexpr int drives = 48, grains_each = 6;
    double squares = 0;
    int count = 0;
    auto const points = scenario::sample_cube(scenario::SampleMethod::sobol, drives * grains_each,
                                              static_cast<int>(inputs().size()), 1);
    for (int i = 0; i < drives; ++i) {
        std::vector<double> found;
        for (int k = 0; k < grains_each; ++k) {
            auto const first = static_cast<std::size_t>(i) * std::size_t{grains_each};
            auto const &drive = points[first], &other = points[first + static_cast<std::size_t>(k)];
            Place place;
            for (std::size_t input = 0; input < drive.size(); ++input) {
                bool const is_unknown =
                    std::find(unknown.begin(), unknown.end(), static_cast<Input>(input)) != unknown.end();
                auto const [low, high] = std::pair{inputs()[input].low, inputs()[input].high};
                place.push_back(low + (high - low) * (is_unknown ? other : drive)[input]);
            }
            if (fixed) place[fixed->first] = fixed->second;
            if (auto const efficiency = efficiency_at(place)) found.push_back(*efficiency);
        }
        double mean = 0;
        for (double const one : found) mean += one / static_cast<double>(found.size());
        for (double const one : found) squares += (one - mean) * (one - mean);
        count += std::max(0, static_cast<int>(found.size()) - 1);
    }
    return std::sqrt(squares / std::max(1, count));
}

}  // namespace vibrotrough::atlas
