#include "scenario/reader/given_values.hpp"

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// The pull that engine.cohesion means depends on the modulus, so that it cannot be chosen.
void check_modulus(Scenario const& s, GivenKeys const& given) {
    if (s.grains.youngs_modulus || s.engine.cohesion <= 0) return;
    given.fail("grains.youngs_modulus",
               "is missing; it cannot be chosen for cohesive grains, because the pull that "
               "engine.cohesion means depends on it",
               "write the modulus for which the cohesion was found, such as \"5 MPa\"");
}

void complete_rotation(Grains& grains, GivenKeys const& given) {
    if (grains.rotation == Rotation::rolling) {
        if (!(grains.rolling_friction > 0))
            given.fail("grains.rotation", "rotation is \"rolling\", but rolling_friction is not above 0",
                       "write rolling_friction = 0.1 or rotation = \"free\"");
        return;
    }
    if (grains.rolling_friction > 0 && !given.has("grains.rotation")) {
        given.fail("grains.rolling_friction", "has no effect on grains that rotate freely",
                   "write rotation = \"rolling\" as well");
    }
    grains.rolling_friction = 0;
}

void check_fractions(std::string_view key, std::vector<double> const& fractions, std::size_t count,
                     GivenKeys const& given) {
    if (fractions.empty() || fractions.size() == count) return;
    given.fail(key, fmt::format("has {} values for {} diameters", fractions.size(), count),
               "list one fraction for each diameter");
}

void complete_sizes(Grains& grains, GivenKeys const& given) {
    bool const is_list = given.has("grains.diameters");
    for (char const* fractions : {"grains.number_fractions", "grains.mass_fractions"}) {
        if (!is_list && given.has(fractions))
            given.fail(fractions, "is given without a list of as many diameters",
                       "write diameters = [\"2 mm\", \"3 mm\"]");
    }
    if (!is_list) return;
    for (char const* other : {"grains.size_law", "grains.diameter_spread"}) {
        if (given.has(other)) given.fail(other, "is given together with a list of diameters", "remove it");
    }
    check_fractions("grains.number_fractions", grains.number_fractions, grains.diameters.size(), given);
    check_fractions("grains.mass_fractions", grains.mass_fractions, grains.diameters.size(), given);
    if (grains.number_fractions.empty() == grains.mass_fractions.empty()) {
        given.fail("grains.diameters", "needs exactly one of number_fractions and mass_fractions",
                   "write mass_fractions = [0.3, 0.7]");
    }
    for (SizeClass const& size : size_classes(grains))
        grains.diameter += size.number_fraction * size.diameter;
}

void check_shape(Grains const& grains, GivenKeys const& given) {
    if (size_classes(grains).size() > 1) {
        given.fail("grains.shape", "clumps must all have the same size",
                   "leave out diameter_spread (or write 0), or use spheres");
    }
    if (grains.rotation == Rotation::rolling) {
        given.fail("grains.shape", "the model of rolling friction is only for spheres",
                   "write rotation = \"free\" or \"blocked\"");
    }
}

}  // namespace

void complete_grains(Scenario& scenario, GivenKeys const& given) {
    check_modulus(scenario, given);
    complete_rotation(scenario.grains, given);
    complete_sizes(scenario.grains, given);
    if (is_clump(scenario.grains)) check_shape(scenario.grains, given);
}

}  // namespace vibrotrough::scenario
