#include "atlas/unknown.hpp"

#include "scenario/reader/sample_cube.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vibrotrough::atlas {
namespace {

std::vector<Input> unknown_of(KnownNumbers const& numbers) {
    std::vector<Input> all;
    for (std::size_t input = 0; input < numbers.size(); ++input)
        if (!numbers[input]) all.push_back(static_cast<Input>(input));
    return all;
}

}  // namespace

double middle_of(Input input) {
    return inputs()[input].value_at(0.5);
}

double sd_of_unknown(std::span<Input const> unknown) {
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
                place.push_back(inputs()[input].value_at((is_unknown ? other : drive)[input]));
            }
            if (auto const efficiency = efficiency_at(place)) found.push_back(*efficiency);
        }
        double mean = 0;
        for (double const one : found) mean += one / static_cast<double>(found.size());
        for (double const one : found) squares += (one - mean) * (one - mean);
        count += std::max(0, static_cast<int>(found.size()) - 1);
    }
    return std::sqrt(squares / std::max(1, count));
}

void PartlyKnown::prepare(KnownNumbers const& numbers) {
    auto const unknown = unknown_of(numbers);
    if (!sd_.contains(unknown)) sd_[unknown] = unknown.empty() ? 0 : sd_of_unknown(unknown);
}

Place PartlyKnown::place_of(KnownNumbers const& numbers) {
    Place place;
    for (std::size_t input = 0; input < numbers.size(); ++input)
        place.push_back(numbers[input].value_or(middle_of(static_cast<Input>(input))));
    return place;
}

std::optional<SurfaceValue> PartlyKnown::operator()(KnownNumbers const& numbers) const {
    auto const sd = sd_.find(unknown_of(numbers));
    if (sd == sd_.end()) throw std::logic_error("these unknown inputs were not prepared");
    auto value = value_at(place_of(numbers));
    if (value) value->half_width = std::hypot(value->half_width, deviations_in_half_width * sd->second);
    return value;
}

}  // namespace vibrotrough::atlas
