#include "deck/phases.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::deck {

std::map<std::string, std::string> phase_sampling(prepare::PreparedCase const& prepared) {
    scenario::Scenario const& s = prepared.scenario;
    prepare::TimeGrid const& time = prepared.time;
    double const diameter = mean_diameter(s);
    // A whole number of columns about 1.5 diameters wide, so that the last one is not narrower.
    double const columns = std::max(1.0, std::round(s.layer.length / (1.5 * diameter)));
    // Slightly more than the exact width, so that rounding does not add a column at the end of the box.
    double const column = s.layer.length / columns * (1 + 1e-12);
    return {{"samples_per_cycle", std::to_string(prepare::phases_per_cycle)},
            {"sample_steps", std::to_string(time.steps_per_cycle / prepare::phases_per_cycle)},
            {"profile_steps", std::to_string(profile_stride * (time.steps_per_cycle / profiles_per_cycle))},
            {"profile_bin", fmt::format("{}", diameter / 2)},
            {"surface_bin", fmt::format("{}", column)}};
}

}  // namespace vibrotrough::deck
