#include "scenario/model/scenario.hpp"

#include "example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

// Gamma = omega^2 r sin(beta) / (g cos(alpha)), K = omega^2 r / g: a dozen roundings at most.
constexpr double rounding = 1e-13;

TEST(Scenario, DriveFromThrowNumber) {
    scenario::Scenario const s = scenario_of(with("inclination = \"0 deg\"", "tan_inclination = 0.1"));
    EXPECT_NEAR(throw_number(s.trough), 2.0, 2 * rounding);
    double const omega = std::sqrt(2.0 * scenario::gravity * std::cos(std::atan(0.1)) /
                                   (6e-3 * std::sin(std::numbers::pi / 6)));
    EXPECT_NEAR(angular_frequency(s.trough), omega, omega * rounding);
    EXPECT_NEAR(velocity_scale(s.trough), omega * 6e-3 * std::cos(std::numbers::pi / 6), rounding);
}

TEST(Scenario, DriveFromMachineNumberOrFrequency) {
    scenario::Scenario const by_number = scenario_of(with("throw_number = 2.0", "machine_number = 4.0"));
    EXPECT_NEAR(machine_number(by_number.trough), 4.0, 4 * rounding);
    // K = Gamma cos(alpha) / sin(beta): at beta = 30 degrees Gamma = K / 2.
    EXPECT_NEAR(throw_number(by_number.trough), 2.0, 2 * rounding);
    scenario::Scenario const by_frequency =
        scenario_of(with("throw_number = 2.0", "frequency = \"774 / minute\""));
    EXPECT_NEAR(by_frequency.trough.frequency, 12.9, 12.9 * rounding);
}

// N = phi L W H / (pi d^3 / 6 (1 + 2 s^2)) with phi = 0.58.
TEST(Scenario, GrainsFromHeight) {
    scenario::Scenario const s = scenario_of(example_campaign);
    double const volume = std::numbers::pi / 6 * 27 * 1.02;
    EXPECT_EQ(s.layer.grains, std::lround(0.58 * 36 * 18 * 12 / volume));
    EXPECT_EQ(s.layer.height, 0.012);
    EXPECT_EQ(scenario_of(with("height = \"12 mm\"", "grains = 600")).layer.grains, 600);
    // Four diameters of 3 mm: the same case, and written as such.
    scenario::Scenario const in_diameters = scenario_of(with("height = \"12 mm\"", "diameters = 4"));
    EXPECT_EQ(in_diameters.layer.grains, s.layer.grains);
    EXPECT_EQ(to_toml(in_diameters), to_toml(s));
}

// The stored text of a case is the case: bit for bit.
TEST(Scenario, TextRoundTrip) {
    for (std::string const& text :
         {example_campaign, with("throw_number = 2.0", "machine_number = 3.3"),
          with("height = \"12 mm\"", "grains = 77"),
          with("vibration_angle = \"30 deg\"", "tan_vibration_angle = 0.3"),
          with("rolling_friction = 0.0", "rolling_friction = 0.1\nrotation = \"rolling\""),
          with("rolling_friction = 0.0", "rotation = \"blocked\"\nsize_law = \"lognormal\""),
          with("diameter_spread = 0.1", "shape = \"rod\""),
          with("diameter = \"3 mm\"\ndiameter_spread = 0.1",
               "diameters = [\"2 mm\", \"3.1 mm\"]\nmass_fractions = [0.3, 0.71]"),
          with("restitution = 0.5", "restitution = 0.5\nside_wall_friction = 0.3"),
          with("throw_number = 2.0",
               "throw_number = 2.0\nalong_phase = \"20 deg\"\n"
               "harmonics = [\"25, 0.2, 0 deg\", \"3, -0.1, -40 deg\"]"),
          with("height = \"12 mm\"", "block = \"point\"", with("diameter_spread = 0.1", ""))}) {
        scenario::Scenario const first = scenario_of(text);
        scenario::Scenario const second = scenario_of(to_toml(first));
        EXPECT_EQ(to_toml(first), to_toml(second));
        EXPECT_EQ(first.trough.frequency, second.trough.frequency);
        EXPECT_EQ(first.trough.vibration_angle, second.trough.vibration_angle);
        EXPECT_EQ(first.grains.youngs_modulus, second.grains.youngs_modulus);
        EXPECT_EQ(first.layer.grains, second.layer.grains);
        EXPECT_EQ(first.measure.max_cycles, second.measure.max_cycles);
    }
}

}  // namespace
}  // namespace vibrotrough
