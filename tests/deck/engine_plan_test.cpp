#include "core/error.hpp"
#include "deck/check.hpp"
#include "deck/deck.hpp"
#include "deck/estimates.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

prepare::PreparedCase prepared(std::string const& engine,
                               std::vector<scenario::NamedFile> const& files = {}) {
    return prepare::prepare_case(
        scenario::parse_campaign(example_campaign + "[engine]\n" + engine, "test.toml", {{}, files})
            .cases.front());
}

Deck deck(std::string const& engine) {
    return make_deck(prepared(engine), {1});
}

std::string digest(std::string const& engine) {
    return digest_of(deck(engine).files);
}

bool holds(std::string const& text, std::string const& part) {
    return text.find(part) != std::string::npos;
}

std::optional<Finding> finding(prepare::PreparedCase const& c, std::string const& begin) {
    for (Finding const& one : check(c)) {
        if (one.item.starts_with(begin)) return one;
    }
    return {};
}

// Gold decks have no section [engine]; with its defaults every byte stays.
TEST(EngineSection, DefaultsChangeNoByte) {
    auto const plain = make_deck(
        prepare::prepare_case(scenario::parse_campaign(example_campaign, "test.toml").cases.front()), {1});
    EXPECT_EQ(deck("contact = \"hertz\"\ncohesion = \"0 J/m3\"\n").files, plain.files);
}

TEST(EngineSection, ContactAndCohesionAreInBothDecksAndAtTheWalls) {
    Deck const both = deck("contact = \"hooke\"\ncohesion = \"2 kJ/m3\"\n");
    for (char const* name : {"settle.liggghts", "in.liggghts"}) {
        std::string const& text = both.files.at(name);
        EXPECT_TRUE(holds(text,
                          "pair_style      gran model hooke tangential history cohesion sjkr limitForce on "
                          "tangential_damping off\n"));
        EXPECT_TRUE(holds(text, "wall/gran model hooke tangential history cohesion sjkr mesh n_meshes 1"));
        EXPECT_TRUE(holds(text, "cohesionEnergyDensity peratomtypepair 2 2000 2000 2000 2000\n"));
        EXPECT_TRUE(holds(text, "characteristicVelocity scalar "));
    }
    EXPECT_TRUE(holds(both.files.at("in.liggghts"), "% of the Hooke contact time"));
    std::string const rolling =
        make_deck(prepare::prepare_case(
                      scenario::parse_campaign(
                          with("rolling_friction = 0.0", "rolling_friction = 0.1\nrotation = \"rolling\"") +
                              "[engine]\ncohesion = \"2 kJ/m3\"\n",
                          "test.toml")
                          .cases.front()),
                  {1})
            .files.at("in.liggghts");
    EXPECT_TRUE(
        holds(rolling, "model hertz tangential history cohesion sjkr rolling_friction epsd2 limitForce"));
}

// The id of a case is a hash of the commands.
TEST(EngineSection, TheModelsBelongToTheId) {
    EXPECT_NE(digest("contact = \"hooke\"\n"), digest(""));
    EXPECT_NE(digest("cohesion = \"1 J/m3\"\n"), digest(""));
}

TEST(EngineSection, TemplatesAreReplaced) {
    auto const with_template = [](std::string const& name, std::string const& text) {
        return make_deck(prepared("templates = [\"" + name + "\"]\n", {{name, text}}), {1});
    };
    Deck const plain = deck("");
    Deck const other = with_template("inputs.mustache", "# {{{grains}}} grains, in my own words\n");
    EXPECT_TRUE(holds(other.files.at("in.liggghts"),
                      fmt::format("\n# {} grains, in my own words\n", prepared("").scenario.layer.grains)));
    Deck const changed = with_template("inputs.mustache", "variable my equal {{{grains}}}\n");
    EXPECT_NE(digest_of(changed.files), digest_of(plain.files));
    EXPECT_EQ(deck("").files, plain.files);
    EXPECT_THROW(with_template("contakt.mustache", ""), core::InputError);
    EXPECT_THROW(with_template("inputs.mustache", "{{#grains}}"), core::InputError);
    EXPECT_THROW(with_template("inputs.mustache", "{{> nothing}}"), core::InputError);
}

// Bo = (2 pi^3 / 3) w^3 R^2 / (E*^2 m g): by hand with w = 50 kJ/m3, R = 1.5 mm, E* = 2.849003e6 Pa and
// m = 1400 kg/m3 pi/6 (3 mm)^3 it is 7.1625e-4 N / 1.9417e-4 N = 3.689. The example's grains are three
// classes whose mean mass is 1 + 2/3 0.1^2 * 3 = 1.02 times that.
TEST(EngineSection, CheckKnowsTheBondNumber) {
    prepare::PreparedCase const cohesive = prepared("cohesion = \"50 kJ/m3\"\n");
    EXPECT_NEAR(bond_number(cohesive), 3.689 / 1.02, 0.002);
    Finding const bond = *finding(cohesive, "bond number (");
    EXPECT_EQ(bond.measured, bond_number(cohesive));
    EXPECT_EQ(bond.severity, Severity::warning);
    EXPECT_NEAR(finding(cohesive, "bond number / throw number")->measured, bond.measured / 2, 1e-12);
    EXPECT_EQ(finding(prepared("cohesion = \"5 kJ/m3\"\n"), "bond number (")->severity, Severity::fine);
    EXPECT_FALSE(finding(prepared(""), "bond number"));
}

// 2 pi R* w against k: from 1 on grains fall into each other.
TEST(EngineSection, CheckKnowsThatHookeDoesNotStick) {
    prepare::PreparedCase const weak = prepared("contact = \"hooke\"\ncohesion = \"1 kJ/m3\"\n"),
                                strong = prepared("contact = \"hooke\"\ncohesion = \"1 MJ/m3\"\n");
    EXPECT_EQ(bond_number(strong), 0);
    EXPECT_EQ(finding(weak, "attraction / spring")->severity, Severity::fine);
    EXPECT_EQ(finding(strong, "attraction / spring")->severity, Severity::error);
    EXPECT_FALSE(finding(prepared("contact = \"hooke\"\n"), "attraction"));
}

}  // namespace
}  // namespace vibrotrough::deck
