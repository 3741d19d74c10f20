#include "scenario/reader/case_maker.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/swept_keys.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

namespace vibrotrough::scenario {
namespace {

class CaseMakerTest : public testing::Test {
  protected:
    CaseMaker maker(std::string const& design) const {
        std::ofstream(file) << example_campaign << design;
        return CaseMaker(file);
    }

    core::TemporaryFolder const folder;
    std::filesystem::path const file = folder.path() / "campaign.toml";
};

constexpr char const* sweep =
    "\n[sweep]\n\"trough.throw_number\" = [1.5, 2.5]\n\"layer.height\" = [\"9 mm\", \"12 mm\"]\n";

// A case made at the values of a case of the campaign is that case.
TEST_F(CaseMakerTest, MakesTheCasesOfTheCampaign) {
    CaseMaker const made = maker(sweep);
    Campaign const campaign = read_campaign(file);
    EXPECT_EQ(to_toml(made.make(
                  {{"trough.throw_number", 2.5}, {"layer.height", made.read_value("layer.height", "9 mm")}})),
              to_toml(campaign.cases[2]));
}

// A throw number replaces the frequency of the file, because the two exclude each other.
TEST_F(CaseMakerTest, ReplacesWhatIsExcluded) {
    Scenario const scenario = maker(sweep).make({{"trough.frequency", 10.0}});
    EXPECT_DOUBLE_EQ(scenario.trough.frequency, 10);
    EXPECT_NEAR(*number_of(scenario, "trough.throw_number"), throw_number(scenario.trough), 1e-12);
}

TEST_F(CaseMakerTest, NamesItsKeys) {
    CaseMaker const made = maker(sweep);
    EXPECT_EQ(made.varied_keys(), (std::vector<std::string>{"trough.throw_number", "layer.height"}));
    EXPECT_EQ(made.full_key("height"), "layer.height");
    EXPECT_THROW(static_cast<void>(made.full_key("friction")), core::InputError);
    CaseMaker const ambiguous =
        maker("\n[sweep]\n\"trough.friction\" = [0.2, 0.3]\n\"grains.friction\" = [0.2, 0.3]\n");
    EXPECT_THROW(static_cast<void>(ambiguous.full_key("friction")), core::InputError);
    EXPECT_EQ(ambiguous.full_key("grains.friction"), "grains.friction");
}

TEST_F(CaseMakerTest, ReadsValuesAsTheCampaignFileDoes) {
    CaseMaker const made = maker(sweep);
    EXPECT_DOUBLE_EQ(std::get<double>(made.read_value("layer.height", "9 mm")), 0.009);
    EXPECT_DOUBLE_EQ(std::get<double>(made.read_value("trough.throw_number", "1.9")), 1.9);
    EXPECT_EQ(std::get<std::string>(made.read_value("grains.rotation", "rolling")), "rolling");
    EXPECT_THROW(static_cast<void>(made.read_value("trough.throw_number", "fast")), core::InputError);
    EXPECT_THROW(static_cast<void>(made.read_value("trough.friction", "-1")), core::InputError);
}

TEST_F(CaseMakerTest, NumbersAndWordsOfACase) {
    Scenario const scenario = read_campaign((maker(sweep), file)).cases.front();
    EXPECT_DOUBLE_EQ(*number_of(scenario, "trough.throw_number"), 1.5);
    EXPECT_DOUBLE_EQ(*number_of(scenario, "layer.height"), 0.009);
    EXPECT_DOUBLE_EQ(*number_of(scenario, "trough.tan_vibration_angle"),
                     std::tan(scenario.trough.vibration_angle));
    EXPECT_EQ(*word_of(scenario, "grains.shape"), "sphere");
    EXPECT_EQ(*word_of(scenario, "engine.contact"), "hertz");
    EXPECT_FALSE(number_of(scenario, "grains.shape"));
    EXPECT_FALSE(word_of(scenario, "layer.height"));
    EXPECT_FALSE(number_of(scenario, "no.such_key"));
}

// [domain] is a Sobol sample of 2 d + 2 points within its ranges, unless `start` gives their number.
TEST_F(CaseMakerTest, Domain) {
    std::string const ranges =
        "\"trough.throw_number\" = { from = 1, to = 3 }\n\"layer.height\" = { from = \"9 mm\", to = \"15 "
        "mm\" }\n";
    CaseMaker const made = maker("\n[domain]\n" + ranges);
    ASSERT_EQ(made.domain().size(), 2U);
    EXPECT_EQ(made.varied_keys().size(), 2U);
    Campaign const campaign = read_campaign(file);
    EXPECT_EQ(campaign.cases.size(), 6U);
    for (Scenario const& scenario : campaign.cases) {
        EXPECT_GE(*number_of(scenario, "layer.height"), 0.009);
        EXPECT_LE(*number_of(scenario, "layer.height"), 0.015);
    }
    maker("\n[domain]\nstart = 7\n" + ranges);
    EXPECT_EQ(read_campaign(file).cases.size(), 7U);
}

TEST_F(CaseMakerTest, WrongDomainsAreRefused) {
    for (char const* domain :
         {"start = 7\n", "start = 1\n\"trough.throw_number\" = { from = 1, to = 3 }\n",
          "\"trough.throw_number\" = { from = 3, to = 1 }\n", "\"trough.throw_number\" = [1, 2]\n",
          "\"grains.shape\" = { from = 1, to = 2 }\n", "\"trough.thrownumber\" = { from = 1, to = 2 }\n"})
        EXPECT_THROW(maker(std::string("\n[domain]\n") + domain), core::InputError) << domain;
}

}  // namespace
}  // namespace vibrotrough::scenario
