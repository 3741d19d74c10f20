#include "scenario/model/materials.hpp"

#include "example_campaign.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

using scenario::Material;
using scenario::Scenario;
using testing::HasSubstr;

std::string const fines = R"([[materials]]
name = "fines"
mass_fraction = 0.3
diameter = "1.5 mm"
density = "2800 kg/m3"
friction = 0.25
trough_friction = 0.1
)";

std::string with_lists(std::string const& lists) {
    return with("diameter_spread = 0.1", "diameter_spread = 0") + lists;
}

double volume_of(double diameter) {
    return std::numbers::pi / 6 * diameter * diameter * diameter;
}

TEST(Materials, WithoutAListThereIsOne) {
    Scenario const s = single_case(example_campaign);
    auto const all = materials(s);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].name, "grains");
    EXPECT_EQ(all[0].number_fraction, 1);
    EXPECT_EQ(all[0].trough_friction, 0.23);
    EXPECT_EQ(mean_diameter(s), s.grains.diameter);
    EXPECT_EQ(mean_density(s), s.grains.density);
    EXPECT_EQ(mean_trough_friction(s), s.trough.friction);
    EXPECT_EQ(mean_trough_restitution(s), s.trough.restitution);
    EXPECT_EQ(mean_grain_volume(s), mean_grain_volume(s.grains));
}

// Share of the mass w_i: n_i m_i / sum(n_j m_j), with m_i = rho_i pi d_i^3 / 6. A grain of 3 mm and 1400
// kg/m3 weighs four times one of 1.5 mm and 2800 kg/m3, so that 0.7 and 0.3 of the mass are 0.7 / 4 to 0.3 by
// number.
TEST(Materials, SharesOfTheMassBecomeNumbers) {
    Scenario const s = single_case(with_lists(fines + "trough_restitution = 0.2\n"));
    auto const all = materials(s);
    ASSERT_EQ(all.size(), 2u);
    double const of_grains = 0.7 / 4 / (0.7 / 4 + 0.3);
    EXPECT_NEAR(all[0].number_fraction, of_grains, 1e-15);  // rounding
    EXPECT_NEAR(all[1].number_fraction, 1 - of_grains, 1e-15);
    // Volumes are as w_i / rho_i: 0.7 / 1400 to 0.3 / 2800.
    double const v = (0.7 / 1400) / (0.7 / 1400 + 0.3 / 2800);
    EXPECT_NEAR(mean_density(s), 1400 * v + 2800 * (1 - v), 1e-9);
    EXPECT_NEAR(mean_diameter(s), 0.003 * v + 0.0015 * (1 - v), 1e-15);
    EXPECT_NEAR(mean_trough_friction(s), 0.7 * 0.23 + 0.3 * 0.1, 1e-15);
    EXPECT_NEAR(mean_trough_restitution(s), 0.7 * 0.5 + 0.3 * 0.2, 1e-15);
    EXPECT_NEAR(mean_grain_volume(s), of_grains * volume_of(0.003) + (1 - of_grains) * volume_of(0.0015),
                1e-20);
}

// The height and the number of grains belong together: N V = 0.58 L W h.
TEST(Materials, TheHeightHasItsNumberOfGrains) {
    Scenario const s = single_case(with_lists(fines));
    EXPECT_NEAR(s.layer.grains * mean_grain_volume(s), 0.58 * 0.036 * 0.018 * 0.012, mean_grain_volume(s));
}

TEST(Materials, WhatAnEntryDoesNotGiveIsThatOfTheGrains) {
    auto const all = materials(
        single_case(example_campaign + "[[materials]]\nname = \"heavy\"\nnumber_fraction = 0.1\ndensity = "
                                       "\"7800 kg/m3\"\n"));
    EXPECT_EQ(all[1].grains.diameter, 0.003);
    EXPECT_EQ(all[1].grains.diameter_spread, 0.1);
    EXPECT_EQ(all[1].grains.friction, 0.5);
    EXPECT_EQ(all[1].trough_friction, 0.23);
    EXPECT_EQ(all[1].trough_restitution, 0.5);
    EXPECT_EQ(all[1].number_fraction, 0.1);
    EXPECT_EQ(all[0].number_fraction, 0.9);
}

// 2 / (1 / 0.5 + 1 / 0.25) = 1/3, unless a pair says otherwise; what it does not say follows the rule.
TEST(Materials, PairsFollowTheRuleOrTheTable) {
    Scenario const s = single_case(with_lists(fines));
    auto const all = materials(s);
    EXPECT_NEAR(contact_of(s, all[0], all[1]).friction, 1.0 / 3, 1e-15);
    EXPECT_EQ(contact_of(s, all[0], all[1]).restitution, 0.5);
    EXPECT_EQ(contact_of(s, all[1], all[1]).friction, 0.25);
    Scenario const given =
        single_case(with_lists(fines + "[[pairs]]\nmaterials = [\"fines\", \"grains\"]\nfriction = 0.9\n"));
    auto const others = materials(given);
    EXPECT_EQ(contact_of(given, others[0], others[1]).friction, 0.9);
    EXPECT_EQ(contact_of(given, others[1], others[0]).friction, 0.9);
    EXPECT_EQ(contact_of(given, others[1], others[0]).restitution, 0.5);
    EXPECT_EQ(contact_of(given, others[0], others[0]).friction, 0.5);
    EXPECT_EQ(scenario::harmonic_mean(0, 0.4), 0);
    EXPECT_EQ(scenario::harmonic_mean(0, 0), 0);
}

TEST(Materials, AreWrittenAndReadBack) {
    Scenario const s =
        single_case(with_lists(fines + "[[pairs]]\nmaterials = [\"fines\", \"grains\"]\nfriction = 0.9\n"));
    std::string const text = to_toml(s);
    EXPECT_THAT(text, HasSubstr("\n[[materials]]\nname = \"fines\"\nmass_fraction = 0.3\n"));
    EXPECT_THAT(text, HasSubstr("\n[[pairs]]\nmaterials = [\"fines\", \"grains\"]\nfriction = 0.9\n"));
    EXPECT_EQ(to_toml(single_case(text)), text);
    // A campaign without them has the text, and with it the ids, of a program that did not know them.
    EXPECT_EQ(to_toml(single_case(example_campaign)).find("materials"), std::string::npos);
}

TEST(Materials, AreVariedByTheirNumber) {
    for (std::string const key : {"\"materials.1.mass_fraction\"", "materials.1.mass_fraction"}) {
        auto const campaign =
            scenario::parse_campaign(with_lists(fines + "[sweep]\n" + key + " = [0.1, 0.2]\n"), "test.toml");
        ASSERT_EQ(campaign.cases.size(), 2u);
        EXPECT_EQ(campaign.cases[1].materials[0].mass_fraction, 0.2);
        EXPECT_EQ(swept_label(campaign.cases[1], campaign.swept), "materials.1.mass_fraction 0.2");
    }
}

TEST(Materials, MistakesAreNamedWithTheirPlace) {
    auto const error = [](std::string const& lists) { return error_of(lists + "\n" + with_lists("")); };
    EXPECT_THAT(error("[[materials]]\nmass_fraction = 0.1"),
                HasSubstr(":2:1: materials.1.mass_fraction: number 1 of [[materials]] has no name"));
    EXPECT_THAT(error("[[materials]]\nname = \"a\""),
                HasSubstr("exactly one of mass_fraction and number_frac"));
    EXPECT_THAT(error("[[materials]]\nname = \"a\"\nmass_fraction = 0.6\n[[materials]]\nname = "
                      "\"b\"\nmass_fraction = 0.5"),
                HasSubstr(":5:1: materials.2.name: the shares of [[materials]] sum to 1.1"));
    EXPECT_THAT(error("[[materials]]\nname = \"a\"\nmass_fraction = 0.6\n[[materials]]\nname = "
                      "\"b\"\nnumber_fraction = 0.1"),
                HasSubstr("some shares are by mass and some are by number"));
    EXPECT_THAT(error("[[materials]]\nname = \"grains\"\nmass_fraction = 0.6"),
                HasSubstr("two materials are called 'grains'"));
    EXPECT_THAT(error("[materials]\nname = \"a\""), HasSubstr("write [[materials]] above each entry"));
    EXPECT_THAT(error("[[materials]]\nname = \"a\"\nmass_fraction = 0.6\nshape = \"cube\""),
                HasSubstr(":4:1: materials.1.shape: unknown key"));
    EXPECT_THAT(error("[[pairs]]\nmaterials = [\"grains\", \"b\"]\nfriction = 0.1"),
                HasSubstr("does not name two different materials of this layer"));
    EXPECT_THAT(error(fines + "[[pairs]]\nmaterials = [\"grains\", \"fines\"]"),
                HasSubstr("gives neither friction nor restitution"));
    EXPECT_THAT(error(fines + "[[pairs]]\nmaterials = [\"grains\", \"fines\"]\nfriction = 0.1\n"
                              "[[pairs]]\nmaterials = [\"fines\", \"grains\"]\nrestitution = 0.3"),
                HasSubstr("fines and grains are given twice"));
    EXPECT_THAT(error(fines + fines + fines + fines), HasSubstr("has 4 entries, more than 3"));
    EXPECT_THAT(error_of(with("rolling_friction = 0.0", "shape = \"cube\"", with_lists(fines))),
                HasSubstr("layers of clumps have only one material"));
    EXPECT_THAT(error("[[materials]]\nname = \"a\"\nnumber_fraction = 0.0001"),
                HasSubstr("fewer than one grain of 'a'"));
}

}  // namespace
}  // namespace vibrotrough
