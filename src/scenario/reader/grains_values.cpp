#include "scenario/reader/given_values.hpp"

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

void check_fractions(std::string_view key, std::vector<double> const& fractions, std::size_t count,
                     GivenKeys const& given) {
    if (fractions.empty() || fractions.size() == count) return;
    given.fail(key, fmt::format("has {} values for {} diameters", fractions.size(), count),
               "list one fraction for each diameter");
}

void complete_sizes(Grains& grains, GivenKeys const& given) {
    if (!given.has("grains.diameters")) return;
    check_fractions("grains.number_fractions", grains.number_fractions, grains.diameters.size(), given);
    check_fractions("grains.mass_fractions", grains.mass_fractions, grains.diameters.size(), given);
    if (grains.number_fractions.empty() == grains.mass_fractions.empty()) {
        given.fail("grains.diameters", "needs exactly one of number_fractions and mass_fractions",
                   "write mass_fractions = [0.3, 0.7]");
    }
    for (SizeClass const& size : size_classes(grains))
        grains.diameter += size.number_fraction * size.diameter;
}

}  // namespace

void complete_grains(Scenario& scenario, GivenKeys const& given) {
    if (scenario.grains.rotation != Rotation::rolling) scenario.grains.rolling_friction = 0;
    complete_sizes(scenario.grains, given);
}

}  // namespace vibrotrough::scenario
