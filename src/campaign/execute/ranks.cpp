#include "campaign/execute/ranks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrotrough::campaign {
namespace {

struct Measured {
    double grains_per_rank;
    double efficiency;
};

/// Two ranks of LIGGGHTS 3.8.0 on two cores, see src/manual/costs.md.
constexpr std::array measured{Measured{252, 0.64}, Measured{1008, 0.75}, Measured{2592, 0.64},
                              Measured{9936, 0.70}};

/// Below this many grains per rank a run is short, and its digits are worth more than its minutes.
constexpr double fewest_grains_per_rank = 1000;
constexpr double least_efficiency = 0.6;

}  // namespace

double parallel_efficiency(double grains_per_rank) {
    if (grains_per_rank < measured.front().grains_per_rank) return 0;
    auto const above = std::ranges::find_if(
        measured, [&](Measured const& one) { return one.grains_per_rank > grains_per_rank; });
    if (above == measured.end()) return measured.back().efficiency;
    Measured const& low = *std::prev(above);
    double const part = std::log(grains_per_rank / low.grains_per_rank) /
                        std::log(above->grains_per_rank / low.grains_per_rank);
    return std::lerp(low.efficiency, above->efficiency, part);
}

int choose_ranks(scenario::RunSettings const& settings, scenario::Scenario const& scenario, int cores) {
    if (settings.ranks) return *settings.ranks;
    for (int ranks = std::min(cores, scenario.layer.grains); ranks > 1; --ranks) {
        double const share = static_cast<double>(scenario.layer.grains) / ranks;
        if (share >= fewest_grains_per_rank && parallel_efficiency(share) >= least_efficiency) return ranks;
    }
    return 1;
}

}  // namespace vibrotrough::campaign
