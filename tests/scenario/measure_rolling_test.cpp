#include "example_campaign.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"

#include <array>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

std::string measuring(std::string const& lines, std::string const& text = example_campaign) {
    return with("max_cycles = 200", "max_cycles = 200\n" + lines, text);
}

TEST(MeasureRolling, IsOffUnlessAskedFor) {
    EXPECT_FALSE(single_case(example_campaign).measure.rolling);
    EXPECT_FALSE(single_case(measuring("rolling = false")).measure.rolling);
    EXPECT_TRUE(single_case(measuring("rolling = true")).measure.rolling);
}

// A case without it has the text that it always had.
TEST(MeasureRolling, IsWrittenOnlyWhenItIsOn) {
    EXPECT_EQ(to_toml(single_case(example_campaign)).find("rolling ="), std::string::npos);
    std::string const text = to_toml(single_case(measuring("rolling = true")));
    EXPECT_EQ(to_toml(single_case(text)), text);
    EXPECT_TRUE(single_case(text).measure.rolling);
}

TEST(MeasureRolling, IsTrueOrFalse) {
    EXPECT_THAT(error_of(measuring("rolling = 1")),
                testing::HasSubstr("measure.rolling: 1 is neither true nor false; write rolling = true"));
    EXPECT_THAT(error_of(measuring("rolling = \"yes\"")),
                testing::HasSubstr("'yes' is neither true nor false"));
    EXPECT_THAT(error_of(example_campaign + "\n[sweep]\n\"measure.rolling\" = [true, false]\n"),
                testing::HasSubstr("a choice between true and false cannot be swept"));
    EXPECT_THAT(error_of(example_campaign + "\n[[points]]\n\"measure.rolling\" = true\n"),
                testing::HasSubstr("this key cannot be varied"));
}

TEST(MeasureRolling, NeedsSpheresWithoutSideWalls) {
    for (auto const& [from, to, named] : std::vector<std::array<std::string, 3>>{
             {"diameter_spread = 0.1", "shape = \"cube\"", "grains.shape is given"},
             {"restitution = 0.5", "restitution = 0.5\nside_wall_friction = 0.3",
              "trough.side_wall_friction is given"},
             {"diameter_spread = 0.1", "diameter_spread = 0.0", "layer.block is given"}}) {
        std::string text = with(from, to);
        if (named.starts_with("layer")) text = with("height = \"12 mm\"", "block = \"point\"", text);
        EXPECT_EQ(error_of(text), "no error");
        EXPECT_THAT(error_of(measuring("rolling = true", text)),
                    testing::AllOf(testing::HasSubstr("measure.rolling"), testing::HasSubstr(named)));
    }
}

}  // namespace
}  // namespace vibrotrough
