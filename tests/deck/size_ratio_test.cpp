#include "core/atomic_file.hpp"
#include "deck/check.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

scenario::Scenario sample() {
    std::filesystem::path const file = std::filesystem::path(CONVERGENCE_FOLDER) / "base.toml";
    return prepare::prepare_case(scenario::parse_campaign(core::read_file(file), "base.toml").cases.front())
        .scenario;
}

Finding finding(scenario::Scenario const& s, std::string const& key, std::string const& part) {
    auto const all = check(prepare::prepare_case(s));
    auto const found = std::ranges::find_if(
        all, [&](Finding const& one) { return one.key == key && one.item.find(part) != std::string::npos; });
    if (found == all.end()) throw std::out_of_range(key);
    return *found;
}

// Spheres of 1 mm and 30 mm: beyond the ratio of 20 that was tried.
TEST(SizeRatio, WarnsBeyondWhatWasTried) {
    scenario::Scenario s = sample();
    EXPECT_NEAR(finding(s, "grains.diameter_spread", "largest sphere").measured, 3.3 / 2.7, 1e-9);
    EXPECT_EQ(finding(s, "grains.diameter_spread", "largest sphere").severity, Severity::fine);
    s.grains.size_law = scenario::SizeLaw::listed;
    s.grains.number_fractions = {0.5, 0.5};
    s.grains.diameters = {0.001, 0.019};
    EXPECT_EQ(finding(s, "grains.diameters", "largest sphere").severity, Severity::fine);
    s.grains.diameters = {0.001, 0.021};
    Finding const beyond = finding(s, "grains.diameters", "largest sphere");
    EXPECT_EQ(beyond.severity, Severity::warning);
    EXPECT_NE(beyond.advice.find("Vyas"), std::string::npos);
}

// A clump of spheres of 1 and 25 units: its own spheres meet those of its neighbours.
TEST(SizeRatio, CountsTheSpheresOfAClump) {
    scenario::Scenario s = sample();
    s.grains.diameter_spread = 0;
    s.grains.shape = "comet.csv";
    s.grains.shape_file = scenario::read_shape({"comet.csv", "x,y,z,radius\n0,0,0,25\n25,0,0,1\n"});
    Finding const beyond = finding(s, "grains.shape", "largest sphere");
    EXPECT_NEAR(beyond.measured, 25, 1e-9);
    EXPECT_EQ(beyond.severity, Severity::warning);
}

}  // namespace
}  // namespace vibrotrough::deck
