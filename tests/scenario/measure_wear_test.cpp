#include "example_campaign.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

std::string wearing(std::string const& lines) {
    return with("max_cycles = 200", "max_cycles = 200\n" + lines);
}

// A case without it has the text that it always had.
TEST(MeasureWear, IsOffUnlessAskedFor) {
    EXPECT_FALSE(single_case(example_campaign).measure.wear);
    EXPECT_EQ(to_toml(single_case(wearing("wear = false"))), to_toml(single_case(example_campaign)));
    std::string const text = to_toml(single_case(wearing("wear = true")));
    EXPECT_TRUE(single_case(text).measure.wear);
    EXPECT_EQ(to_toml(single_case(text)), text);
}

TEST(MeasureWear, IsNotForStages) {
    std::string const stages = "\n[[stages]]\ncycles = 20\n\n[[stages]]\ncycles = 20\nthrow_number = 1.5\n";
    std::string const plain = with("max_cycles = 200", "");
    EXPECT_EQ(error_of(plain + stages), "no error");
    EXPECT_THAT(error_of(with("max_cycles = 200", "wear = true") + stages),
                testing::HasSubstr("measure.wear: the wear is not measured in stages"));
}

}  // namespace
}  // namespace vibrotrough
