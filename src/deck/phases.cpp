#include "deck/phases.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::deck {

std::map<std::string, std::string> phase_sampling(prepare::PreparedCase const& prepared) {
    scenario::Scenario const& s = prepared.scenario;
    prepare::TimeGrid const& time = prepared.time;
    double const diameter = s.grains.diameter;
    // Columns a grain and a half wide, a whole number of them: the last one is not narrower.
    double const columns = std::max(1.0, std::round(s.layer.length / (1.5 * diameter)));
    // A little more than the exact width: rounding must not open one more column at the box's end.
    double const column = s.layer.length / columns * (1 + 1e-12);
    return {{"samples_per_cycle", std::to_string(prepare::phases_per_cycle)},
            {"sample_steps", std::to_string(time.steps_per_cycle / prepare::phases_per_cycle)},
            {"profile_steps", std::to_string(profile_stride * (time.steps_per_cycle / profiles_per_cycle))},
            {"profile_bin", fmt::format("{}", diameter / 2)},
            {"surface_bin", fmt::format("{}", column)}};
}

}  // namespace vibrotrough::deck
