#include "scenario/model/softness.hpp"

#include "core/error.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::prepare {
namespace {

std::string without_modulus(std::string const& text = example_campaign) {
    return with("youngs_modulus = \"5 MPa\"\n", "", text);
}

// s = omega h / c, c = (E* / rho)^(1/3) (p / rho)^(1/6), p = 0.58 rho h g cos(alpha) (1 + Gamma) / 2. Worked
// out here from the case's own numbers in another order: c^6 = (E* / rho)^2 p / rho.
TEST(Softness, TheWaveNumberIsTheAngleOfACrossing) {
    PreparedCase const c = prepare_case(scenario_of(example_campaign));
    scenario::Grains const& grains = c.scenario.grains;
    double const h = c.layer_height, nu = grains.poisson_ratio;
    double const stiff = 5e6 / (2 * (1 - nu * nu)) / grains.density;
    double const press = 0.58 * h * 9.81 * std::cos(c.scenario.trough.inclination) * (1 + c.throw_number) / 2;
    double const speed = std::pow(stiff * stiff * press, 1.0 / 6);
    double const expected = 2 * std::numbers::pi * c.scenario.trough.frequency * h / speed;
    EXPECT_NEAR(wave_number(c.scenario, 5e6), expected, 1e-12 * expected);
    EXPECT_NEAR(wave_number(c.scenario, 8 * 5e6), expected / 2, 1e-12 * expected) << "s goes with E^(-1/3)";
}

// The wave number is at most the limit, and that of the next softer value of the series is not.
TEST(Softness, TheChosenModulusIsTheLowestThatIsStiffEnough) {
    PreparedCase const c = prepare_case(scenario_of(example_campaign));
    for (double const limit : {0.1, 0.05, 0.02}) {
        double const modulus = stiff_enough(c.scenario, limit);
        EXPECT_LE(wave_number(c.scenario, modulus), limit * (1 + 1e-9));
        EXPECT_GT(wave_number(c.scenario, modulus / 1.55), limit)
            << "the steps of the series are at most 1.5";
    }
    EXPECT_EQ(stiff_enough(c.scenario, 3), 2e6) << "softer grains were not simulated";
}

TEST(Softness, WithoutAModulusACaseGetsOne) {
    PreparedCase const given = prepare_case(scenario_of(example_campaign)),
                       chosen = prepare_case(scenario_of(without_modulus()));
    EXPECT_FALSE(given.scenario.grains.is_modulus_chosen);
    EXPECT_TRUE(chosen.scenario.grains.is_modulus_chosen);
    EXPECT_EQ(chosen.scenario.grains.youngs_modulus, stiff_enough(given.scenario, 0.079));
    // The error is at most half of the usual half-width: 4 s^2 = 0.025.
    EXPECT_LE(chosen.numerics.softness, 0.025);
    EXPECT_FALSE(is_soft(chosen.scenario));
    // The frozen case holds the number, so that it stays the same when the rule changes.
    EXPECT_NE(to_toml(chosen.scenario).find("youngs_modulus"), std::string::npos);
}

// What is asked for must not change the physics: the modulus and the id stay under a narrower half-width.
TEST(Softness, ANarrowerHalfWidthIsTheSameCase) {
    auto const asked = [](std::string const& half_width) {
        return prepare_case(
                   scenario_of(with("half_width = 0.02", "half_width = " + half_width, without_modulus())))
            .scenario;
    };
    EXPECT_EQ(asked("0.05").grains.youngs_modulus, asked("0.01").grains.youngs_modulus);
    EXPECT_EQ(identity_of(asked("0.05")), identity_of(asked("0.01")));
}

// All cases have the modulus that the most demanding one needs, the deepest or fastest.
TEST(Softness, ACampaignHasOneModulus) {
    std::string const swept = with("height = \"12 mm\"\n", "", without_modulus()) +
                              "\n[sweep]\nlayer.height = [\"9 mm\", \"18 mm\", \"42 mm\"]\n";
    auto const cases = scenario::parse_campaign(swept, "x").cases;
    ASSERT_EQ(cases.size(), 3U);
    for (scenario::Scenario const& one : cases)
        EXPECT_EQ(one.grains.youngs_modulus, stiff_enough(cases.back(), 0.079));
}

// A deeper layer needs stiffer grains, whatever the modulus of its neighbour in the campaign.
TEST(Softness, ADeepLayerGetsStifferGrains) {
    auto const modulus = [](std::string const& height) {
        return *prepare_case(scenario_of(with("height = \"12 mm\"", height, without_modulus())))
                    .scenario.grains.youngs_modulus;
    };
    EXPECT_LT(modulus("height = \"9 mm\""), modulus("height = \"18 mm\""));
    EXPECT_LT(modulus("height = \"18 mm\""), modulus("height = \"42 mm\""));
}

TEST(Softness, DeepLayersOfFiveMegapascalsAreSoft) {
    EXPECT_TRUE(
        is_soft(prepare_case(scenario_of(with("height = \"12 mm\"", "height = \"42 mm\""))).scenario));
    EXPECT_FALSE(
        is_soft(prepare_case(scenario_of(with("height = \"12 mm\"", "height = \"6 mm\""))).scenario));
}

// A block has a contact of its own, and its modulus does not matter.
TEST(Softness, ABlockHasNone) {
    std::string const one_size = with("diameter_spread = 0.1", "diameter_spread = 0.0", without_modulus());
    PreparedCase const c =
        prepare_case(scenario_of(with("height = \"12 mm\"", "block = \"point\"", one_size)));
    EXPECT_EQ(c.numerics.total(), 0) << "its meshes are exact, and it has no layer";
    EXPECT_FALSE(is_soft(c.scenario));
}

// The pull of cohesive grains goes with w^3 / E^2: another modulus would be another cohesion.
TEST(Softness, CohesiveGrainsNeedAGivenModulus) {
    std::string const text = without_modulus() + "\n[engine]\ncohesion = \"50 kJ/m3\"\n";
    EXPECT_THROW(scenario::parse_campaign(text, "example.toml"), core::InputError);
}

}  // namespace
}  // namespace vibrotrough::prepare
