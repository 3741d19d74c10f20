#include "scenario/keys.hpp"

#include "core/atomic_file.hpp"
#include "core/quantity.hpp"
#include "scenario/campaign_file.hpp"

#include <set>

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

// The reference in the README is the program's own table: a second copy that drifts fails here.
TEST(Keys, ReadmeHoldsTheReference) {
    EXPECT_NE(read_file(README_FILE).find(key_reference()), std::string::npos)
        << "write the output of 'vibrotrough keys' into README.md";
}

// What an error tells people to write must be right.
TEST(Keys, ExamplesAreInRange) {
    for (Key const& key : all_keys()) {
        bool const is_number =
            key.kind == KeyKind::quantity || key.kind == KeyKind::number || key.kind == KeyKind::integer;
        if (!is_number) continue;
        std::string const example(key.example);
        double const value =
            key.kind == KeyKind::quantity
                ? parse_quantity(example.substr(1, example.size() - 2), std::string(key.unit))
                : std::stod(example);
        EXPECT_GE(value, key.least) << key.path;
        EXPECT_LE(value, key.most) << key.path;
    }
}

TEST(Keys, ChoicesAreTheWordsOfTheRange) {
    using Words = std::vector<std::string_view>;
    EXPECT_EQ(choices(*find_key("grains.rotation")), (Words{"free", "rolling", "blocked"}));
    EXPECT_EQ(choices(*find_key("layer.block")), (Words{"point", "plate"}));
}

TEST(Keys, MisspeltKeysAreGuessed) {
    EXPECT_EQ(nearest_key("trough.trow_number"), "trough.throw_number");
    EXPECT_EQ(nearest_key("grains.diametre"), "grains.diameter");
    EXPECT_EQ(nearest_key("something else entirely"), "");
    EXPECT_EQ(nearest_key(std::string(100'000, 'x')), "");
    EXPECT_EQ(find_key("trough.friction")->path, "trough.friction");
    EXPECT_EQ(find_key("trough.Friction"), nullptr);
}

}  // namespace
}  // namespace vibrotrough
