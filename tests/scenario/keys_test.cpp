#include "scenario/reader/keys.hpp"

#include "core/quantity.hpp"
#include "example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/key_schema.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough {
namespace {

using nlohmann::literals::operator""_json_pointer;

// The examples are quoted in errors, so they must be valid.
TEST(Keys, ExamplesAreInRange) {
    for (scenario::Key const& key : scenario::all_keys()) {
        bool const is_number = key.kind == scenario::KeyKind::quantity ||
                               key.kind == scenario::KeyKind::number ||
                               key.kind == scenario::KeyKind::integer;
        if (!is_number) continue;
        std::string const example(key.example);
        double const value =
            key.kind == scenario::KeyKind::quantity
                ? core::parse_quantity(example.substr(1, example.size() - 2), std::string(key.unit))
                : std::stod(example);
        EXPECT_GE(value, key.least) << key.path;
        EXPECT_LE(value, key.most) << key.path;
    }
}

// A row says where its value is: in a case or among the settings of a run, never in both.
TEST(Keys, EveryRowHasItsPlace) {
    for (scenario::Key const& key : scenario::all_keys()) {
        EXPECT_TRUE((key.access.get != nullptr && key.access.set != nullptr) ||
                    (key.access.get_entry != nullptr && key.access.set_entry != nullptr))
            << key.path;
        EXPECT_TRUE(key.access.set_run == nullptr) << key.path;
    }
    for (scenario::Key const& key : scenario::run_keys()) {
        EXPECT_TRUE(key.access.get == nullptr && key.access.set == nullptr) << key.path;
        EXPECT_TRUE(key.access.set_run != nullptr) << key.path;
    }
}

bool is_of_a_list(scenario::Key const& key) {
    return scenario::is_list_section(key.path.substr(0, key.path.find('.')));
}

// What is put into a case comes out of it again: get() undoes set(), also where a key shares its member with
// others of its group. Keys that name files are in the tests of these files.
TEST(Keys, WhatIsSetIsGot) {
    std::string const base = with("rolling_friction = 0.0", "rotation = \"rolling\"\nrolling_friction = 0.2",
                                  with("diameter_spread = 0.1", "diameter_spread = 0"));
    std::string lists;
    for (std::string const name : {"a", "b", "c"})
        lists += fmt::format("[[materials]]\nname = \"{}\"\nmass_fraction = 0.1\n", name);
    for (std::string const pair : {"\"a\", \"b\"", "\"a\", \"c\"", "\"b\", \"c\"", "\"grains\", \"a\"",
                                   "\"grains\", \"b\"", "\"grains\", \"c\""})
        lists += fmt::format("[[pairs]]\nmaterials = [{}]\nfriction = 0.1\n", pair);
    for (scenario::Key const& key : scenario::all_keys()) {
        if (!can_vary(key) || key.kind == scenario::KeyKind::file || key.kind == scenario::KeyKind::files)
            continue;
        if (key.path.ends_with("number_fraction")) continue;  // excludes mass_fraction: materials_test.cpp
        if (key.path == "trough.mesh_unit") continue;         // needs a mesh: trough_mesh_test.cpp
        if (key.path == "trough.waveform_order") continue;    // needs a record: waveform_test.cpp
        if (key.path.starts_with("stages.")) continue;        // exclude keys of [measure]: stages_test.cpp
        if (key.path.starts_with("screen.")) continue;        // so do these: screen_test.cpp
        std::string point = (is_of_a_list(key) ? lists : "") +
                            fmt::format("[[points]]\n\"{}\" = {}\n", key.path, key.example);
        if (key.path.starts_with("feed.")) point += "\"trough.side_wall_friction\" = 0\n";
        if (key.path == "feed.length" || key.path == "feed.width" || key.path == "feed.height")
            point += "\"feed.mass_flow\" = \"0.2 t/h\"\n";
        scenario::Scenario const s = scenario::parse_campaign(base + point, "c.toml").cases.front();
        scenario::Content const got = *key.get(s);
        if (has_words(key)) {
            EXPECT_EQ('"' + std::get<std::string>(got) + '"', key.example) << key.path;
            continue;
        }
        std::string const example(key.example);
        double const given =
            key.kind == scenario::KeyKind::quantity
                ? core::parse_quantity(example.substr(1, example.size() - 2), std::string(key.unit))
                : std::stod(example);
        EXPECT_NEAR(std::get<double>(got), given, 1e-14 * std::abs(given)) << key.path;
    }
}

// The members begin with what the reference calls the default of a word: nothing else sets it.
TEST(Keys, WordsBeginWithTheirDefault) {
    for (scenario::Key const& key : scenario::all_keys()) {
        if (!has_words(key) || !key.group.empty()) continue;
        auto const value = key.get(scenario::Scenario{});
        EXPECT_EQ(value ? std::get<std::string>(*value) : "none", default_text(key)) << key.path;
    }
}

// Editors know every key where it is written, and those that can be varied in the sections that vary them.
TEST(Keys, TheSchemaHasEveryKey) {
    auto const schema = nlohmann::json::parse(scenario::key_schema());
    std::vector<scenario::Key> all(scenario::all_keys().begin(), scenario::all_keys().end());
    all.insert(all.end(), scenario::run_keys().begin(), scenario::run_keys().end());
    for (scenario::Key const& key : all) {
        std::string path(key.path);
        // The entries of a list share one schema: materials.2.name is the name of its items.
        if (is_of_a_list(key))
            path = path.substr(0, path.find('.')) + ".items." + path.substr(path.rfind('.') + 1);
        std::string place = "/properties/" + path;
        for (auto dot = place.find('.'); dot != place.npos; dot = place.find('.'))
            place.replace(dot, 1, place.substr(dot).starts_with(".items") ? "/" : "/properties/");
        nlohmann::json::json_pointer const pointer(place);
        ASSERT_TRUE(schema.contains(pointer)) << place;
        EXPECT_TRUE(schema.at(pointer).contains("description")) << place;
    }
    auto const& varied = schema.at("definitions").at("varied").at("properties");
    EXPECT_TRUE(varied.contains("grains.rotation"));
    EXPECT_FALSE(varied.contains("campaign.name") || varied.contains("trough.harmonics"));
    EXPECT_EQ(schema.at("/properties/grains/properties/rotation/enum"_json_pointer),
              (nlohmann::json{"free", "rolling", "blocked"}));
    EXPECT_EQ(schema.at("/properties/sweep/$ref"_json_pointer), "#/definitions/varied");
}

TEST(Keys, ChoicesAreTheWordsOfTheRange) {
    using Words = std::vector<std::string_view>;
    EXPECT_EQ(choices(*scenario::find_key("grains.rotation")), (Words{"free", "rolling", "blocked"}));
    EXPECT_EQ(choices(*scenario::find_key("layer.block")), (Words{"point", "plate"}));
}

TEST(Keys, MisspeltKeysAreGuessed) {
    EXPECT_EQ(scenario::nearest_key("trough.trow_number"), "trough.throw_number");
    EXPECT_EQ(scenario::nearest_key("grains.diametre"), "grains.diameter");
    EXPECT_EQ(scenario::nearest_key("something else entirely"), "");
    EXPECT_EQ(scenario::nearest_key(std::string(100'000, 'x')), "");
    EXPECT_EQ(scenario::find_key("trough.friction")->path, "trough.friction");
    EXPECT_EQ(scenario::find_key("trough.Friction"), nullptr);
}

}  // namespace
}  // namespace vibrotrough
