#include "scenario/reader/cannot.hpp"

#include "example_campaign.hpp"
#include "scenario/reader/keys.hpp"
#include "single_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::scenario {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// What people ask for and the program cannot do is said, with what can be done instead, and without a key
// that is only spelt like it.
TEST(Cannot, IsAnAnswer) {
    for (auto const& [line, words] : {std::pair{"rotation_amplitude = \"2 deg\"", "rocks or turns"},
                                      {"skirt = \"skirt.stl\"", "skirt at rest"},
                                      {"motion.skirt.standstill = true", "move differently"},
                                      {"hopper_angle = \"30 deg\"", "hoppers"},
                                      {"angle_of_repose = \"30 deg\"", "heap"},
                                      {"moisture = 0.1", "liquid bridges"},
                                      {"air_pressure = \"1 bar\"", "air is not simulated"},
                                      {"wear_rate = 1", "wear"},
                                      {"spring_constant = 1", "gives way"},
                                      {"temperature = 20", "heat"},
                                      {"bowl_diameter = \"1 m\"", "bowls"}}) {
        EXPECT_THAT(error_of(with("[grains]", std::string(line) + "\n\n[grains]")),
                    AllOf(HasSubstr(words), HasSubstr("scope.md"), Not(HasSubstr("did you mean"))))
            << line;
    }
    EXPECT_THAT(error_of(with("diameter = \"3 mm\"", "diameter = \"3 mm\"\nshape = \"flake\"")),
                AllOf(HasSubstr("polyhedra"), HasSubstr("a clump of spheres of your own")));
    EXPECT_THAT(error_of(with("[grains]", "[hopper]\nangle = 1\n\n[grains]")), HasSubstr("hoppers"));
}

TEST(Cannot, IsNoKeyOfOurs) {
    for (Key const& key : all_keys()) EXPECT_EQ(cannot_simulate(last_name(key.path)), nullptr) << key.path;
}

}  // namespace
}  // namespace vibrotrough::scenario
