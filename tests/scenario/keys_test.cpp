#include "scenario/reader/keys.hpp"

#include "core/atomic_file.hpp"
#include "core/quantity.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <set>

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

// The table of keys in src/scenario/README.md is the one that the program prints.
TEST(Keys, ReadmeHoldsTheReference) {
    EXPECT_NE(core::read_file(README_FILE).find(scenario::key_reference()), std::string::npos)
        << "paste the output of 'vibrotrough keys' into " << README_FILE;
}

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
