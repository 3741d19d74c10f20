#include "example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/swept_keys.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::scenario {
namespace {

using testing::HasSubstr;

FileSource const known_files{{}, {{"contact.mustache", "text"}}};

Campaign campaign(std::string const& engine, std::string const& text = example_campaign) {
    return parse_campaign(text + "[engine]\n" + engine, "test.toml", known_files);
}

std::string engine_error(std::string const& engine) {
    return error_of(example_campaign + "[engine]\n" + engine, known_files);
}

// A case without the section is written as it always was, so that its id stays.
TEST(EnginePlan, NothingIsWrittenWithoutIt) {
    Scenario const s = parse_campaign(example_campaign, "test.toml").cases.front();
    EXPECT_EQ(to_toml(s).find("[engine]"), std::string::npos);
    EXPECT_EQ(to_toml(s), to_toml(campaign("contact = \"hertz\"\ncohesion = \"0 J/m3\"\n").cases.front()));
    EXPECT_EQ(not_covered(s.engine), "");
    EXPECT_TRUE(named_files(s).empty());
}

TEST(EnginePlan, IsReadAndWrittenBack) {
    Scenario const s = campaign(
                           "contact = \"hooke\"\ncohesion = \"0.05 MJ/m3\"\ntemplates = "
                           "[\"contact.mustache\"]\n")
                           .cases.front();
    EXPECT_EQ(s.engine.contact, ContactModel::hooke);
    EXPECT_NEAR(s.engine.cohesion, 5e4, 1e-9);
    EXPECT_EQ(not_covered(s.engine), "contact hooke, cohesion sjkr, template contact.mustache");
    EXPECT_EQ(named_files(s).size(), 1u);
    Scenario const again = parse_campaign(to_toml(s), "again", {{}, named_files(s)}).cases.front();
    EXPECT_EQ(to_toml(again), to_toml(s));
    EXPECT_EQ(again.engine.templates->files.front().content, "text");
}

TEST(EnginePlan, IsSwept) {
    Campaign const swept = parse_campaign(example_campaign +
                                              "[sweep]\n\"engine.contact\" = [\"hertz\", \"hooke\"]\n"
                                              "\"engine.cohesion\" = [\"0 J/m3\", \"1 kJ/m3\"]\n",
                                          "test.toml", known_files);
    ASSERT_EQ(swept.cases.size(), 4u);
    EXPECT_EQ(std::get<std::string>(*key_value(swept.cases.back(), "engine.contact")), "hooke");
    auto const read = parse_campaign(campaign_toml(swept.cases, "all"), "all.toml", known_files).cases;
    ASSERT_EQ(read.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(to_toml(read[i]), to_toml(swept.cases[i]));
}

TEST(EnginePlan, MistakesAreNamed) {
    EXPECT_THAT(engine_error("contact = \"jkr\"\n"),
                HasSubstr("engine.contact: 'jkr' is not an allowed value"));
    EXPECT_THAT(engine_error("cohesion = \"-1 J/m3\"\n"), HasSubstr("out of range"));
    EXPECT_THAT(engine_error("cohesion = 5\n"), HasSubstr("no unit"));
    for (char const* name : {"../a.mustache", "contact", "x.csv"})
        EXPECT_THAT(engine_error("templates = [\"" + std::string(name) + "\"]\n"),
                    HasSubstr("name of a template"));
    EXPECT_THAT(engine_error("templates = [\"contact.mustache\", \"contact.mustache\"]\n"),
                HasSubstr("twice"));
}

}  // namespace
}  // namespace vibrotrough::scenario
