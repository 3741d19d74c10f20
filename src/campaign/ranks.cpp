#include "campaign/ranks.hpp"

#include <algorithm>

namespace vibrotrough::campaign {

int choose_ranks(RunSettings const& settings, Scenario const& scenario, int cores) {
    if (settings.ranks) return *settings.ranks;
    constexpr int fewest_grains = 10'000;
    return std::clamp(scenario.layer.grains / fewest_grains, 1, std::max(1, cores));
}

}  // namespace vibrotrough::campaign
