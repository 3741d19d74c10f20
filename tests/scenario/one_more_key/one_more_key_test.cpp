#include "core/error.hpp"
#include "example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/case_maker.hpp"
#include "scenario/reader/key_schema.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// This program is the room with one key more, solver.test_length, which add_key.cmake adds as one member and
// one row. Nothing else of the room knows it, and it works in every place in which a key works.
namespace vibrotrough::scenario {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr char const* path = "solver.test_length";
std::string const with_key = example_campaign + "[solver]\ntest_length = \"5 mm\"\n";
std::string const swept = example_campaign + "[sweep]\n\"solver.test_length\" = [\"2 mm\", \"3 mm\"]\n";

std::string error_of(std::string const& text) {
    try {
        parse_campaign(text, "c.toml");
    } catch (core::InputError const& error) {
        return error.what();
    }
    return "no error";
}

TEST(OneMoreKey, IsReadAndHasADefault) {
    EXPECT_EQ(parse_campaign(with_key, "c.toml").cases.front().solver.test_length, 0.005);
    EXPECT_EQ(parse_campaign(example_campaign, "c.toml").cases.front().solver.test_length, 0.007);
}

TEST(OneMoreKey, IsWrittenAndReadBack) {
    std::string const text = to_toml(parse_campaign(with_key, "c.toml").cases.front());
    EXPECT_THAT(text, HasSubstr("block_stiffness = 300\ntest_length = \"0.005 m\"\n"));
    EXPECT_EQ(to_toml(parse_campaign(text, "c.toml").cases.front()), text);
}

TEST(OneMoreKey, IsVaried) {
    Campaign const campaign = parse_campaign(swept, "c.toml");
    ASSERT_EQ(campaign.cases.size(), 2u);
    EXPECT_THAT(campaign.swept, ElementsAre(find_key(path)));
    EXPECT_EQ(swept_label(campaign.cases[1], campaign.swept), "solver.test_length 3 mm");
    EXPECT_EQ(number_of(campaign.cases[0], path), 0.002);
    Campaign const again = parse_campaign(campaign_toml(campaign.cases, "a comment"), "again.toml");
    ASSERT_EQ(again.cases.size(), 2u);
    EXPECT_EQ(again.cases[1].solver.test_length, 0.003);
    for (std::string const list :
         {"[zip]\n\"solver.test_length\" = [\"2 mm\", \"3 mm\"]\n",
          "[[points]]\n\"solver.test_length\" = \"3 mm\"\n",
          "[sample]\nmethod = \"sobol\"\ncount = 2\n\"solver.test_length\" = { from = "
          "\"2 mm\", to = \"3 mm\" }\n"})
        EXPECT_NE(parse_campaign(example_campaign + list, "c.toml").cases.back().solver.test_length, 0.007)
            << list;
}

TEST(OneMoreKey, LeavesOutCases) {
    std::string const exclusion = "[[exclude]]\n\"solver.test_length\" = { above = \"2.5 mm\" }\n";
    Campaign const campaign = parse_campaign(swept + exclusion, "c.toml");
    EXPECT_EQ(campaign.excluded, 1u);
    EXPECT_EQ(campaign.cases.front().solver.test_length, 0.002);
}

TEST(OneMoreKey, HasErrorsWithAPlace) {
    auto const at_line = [](std::string const& value) {
        return error_of("[solver]\ntest_length = " + value + "\n" + example_campaign);
    };
    EXPECT_EQ(at_line("5"),
              "c.toml:2:15: solver.test_length: the number 5 has no unit; write test_length = \"5 mm\"");
    EXPECT_EQ(at_line("\"2 m\""),
              "c.toml:2:15: solver.test_length: '2 m' is out of range; write test_length = \"5 mm\", in the "
              "range 1 mm to 1 m");
    EXPECT_EQ(error_of("[solver]\ntest_lenght = 5\n" + example_campaign),
              "c.toml:2:1: solver.test_lenght: unknown key; did you mean solver.test_length?");
}

TEST(OneMoreKey, IsInTheReferenceAndCompletedByEditors) {
    EXPECT_THAT(
        key_reference(),
        HasSubstr("| `solver.test_length` | `\"5 mm\"` | 1 mm to 1 m | 0.007 | a length of this test |"));
    auto const schema = nlohmann::json::parse(key_schema());
    auto const& key = schema.at("properties").at("solver").at("properties").at("test_length");
    EXPECT_EQ(key.at("type"), "string");
    EXPECT_EQ(key.at("description"), "a length of this test; 1 mm to 1 m");
    EXPECT_TRUE(schema.at("definitions").at("varied").at("properties").contains(path));
}

}  // namespace
}  // namespace vibrotrough::scenario
