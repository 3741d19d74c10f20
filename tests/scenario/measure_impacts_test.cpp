#include "example_campaign.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

using testing::HasSubstr;

std::string with_impacts(std::string const& lines) {
    return with("max_cycles = 200", "max_cycles = 200\n" + lines);
}

// A case without it has the text that it always had.
TEST(MeasureImpacts, IsOffUnlessAskedFor) {
    EXPECT_FALSE(single_case(example_campaign).measure.impacts);
    EXPECT_EQ(to_toml(single_case(with_impacts("impacts = false"))), to_toml(single_case(example_campaign)));
    std::string const text = to_toml(single_case(with_impacts("impacts = true")));
    EXPECT_TRUE(single_case(text).measure.impacts);
    EXPECT_EQ(to_toml(single_case(text)), text);
}

TEST(MeasureImpacts, IsForSpheresWithoutCohesion) {
    std::string const text = with_impacts("impacts = true");
    EXPECT_THAT(error_of(text + "\n[engine]\ncohesion = \"50 kJ/m3\"\n"),
                HasSubstr("measure.impacts: impacts are measured only in layers of spheres without cohesion, "
                          "and engine.cohesion is given"));
    std::string const stages = "\n[[stages]]\ncycles = 20\n";
    EXPECT_THAT(error_of(with("max_cycles = 200", "impacts = true") + stages),
                HasSubstr("measure.impacts: impacts are not measured in stages"));
}

}  // namespace
}  // namespace vibrotrough
