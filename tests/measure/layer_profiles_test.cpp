#include "measure/layer_profiles.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

class Snapshots : public testing::Test {
  protected:
    void write(std::string const& name, std::string const& text) const {
        std::ofstream(folder / name) << text;
    }
    /// Three bins: empty, `grains` grains at v_x = step, the same at v_x = 2 step.
    static std::string snapshot(int step, int grains = 10) {
        return fmt::format("{} 3\n  1 0.5 0 0 0 0\n  2 1.5 {} 700 {} 0.5\n  3 2.5 {} 350 {} 0.25\n", step,
                           grains, step, grains, 2 * step);
    }
    std::vector<Snapshot> read() const { return read_snapshots(folder, "profiles"); }
    std::string error_of(std::string const& text) const {
        write("profiles.0.txt", text);
        try {
            read();
        } catch (core::InputError const& error) {
            return error.what();
        }
        return "no error";
    }

    core::TemporaryFolder const own_folder;
    std::filesystem::path folder = own_folder.path();
    std::string const head = "# Spatial-averaged data\n# Timestep Number-of-bins\n";
};

TEST_F(Snapshots, AreRead) {
    write("profiles.0.txt", head + snapshot(0) + snapshot(30));
    write("surface.0.txt", "not looked at");
    write("profiles.old.txt", "not looked at");
    auto const snapshots = read();
    ASSERT_EQ(snapshots.size(), 2u);
    EXPECT_EQ(snapshots[1].step, 30);
    ASSERT_EQ(snapshots[1].bins.size(), 3u);
    EXPECT_EQ(snapshots[1].bins[1].position, 1.5);
    EXPECT_EQ(snapshots[1].bins[1].grains, 10);
    EXPECT_EQ(snapshots[1].bins[1].density, 700);
    EXPECT_EQ(snapshots[1].bins[2].means, (std::vector<double>{60, 0.25}));
}

// A run that was interrupted and continued from step 60 repeats the later steps of the first run.
TEST_F(Snapshots, OfALaterRunReplaceWhatItDidAgain) {
    write("profiles.0.txt",
          head + snapshot(0) + snapshot(30) + snapshot(60) + snapshot(90) + "120 3\n  1 0.5 ");
    write("profiles.60.txt", head + snapshot(60, 20) + snapshot(90, 20));
    auto const snapshots = read();
    ASSERT_EQ(snapshots.size(), 4u);
    EXPECT_EQ(snapshots[1].bins[1].grains, 10);
    EXPECT_EQ(snapshots[2].step, 60);
    EXPECT_EQ(snapshots[2].bins[1].grains, 20);
}

TEST_F(Snapshots, AreReadAtAnyMoment) {
    std::string const whole = head + snapshot(0) + snapshot(30);
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        write("profiles.0.txt", whole.substr(0, size));
        for (Snapshot const& one : read()) EXPECT_EQ(one.bins.size(), 3u) << size;
    }
}

TEST_F(Snapshots, AreRefusedWhenDamaged) {
    EXPECT_THROW(read(), core::MissingError);
    EXPECT_NE(error_of("x 3\n").find(":1: the line is damaged; expected a step and a number of bins"),
              std::string::npos);
    EXPECT_NE(error_of("0 0\n").find("damaged"), std::string::npos);
    EXPECT_NE(error_of("0 1e300\n").find("damaged"), std::string::npos);
    EXPECT_NE(error_of("0 2\n1 2 3\n").find(":2: the line is damaged; expected the numbers of a bin"),
              std::string::npos);
    EXPECT_NE(error_of("0 2\n1 2 3 4 5a\n").find("damaged"), std::string::npos);
    EXPECT_NE(error_of(snapshot(0) + "30 1\n1 0.5 0 0 0 0\n").find("different size"), std::string::npos);
}

ProfileFacts profile_facts(int discarded, int used) {
    ProfileFacts facts{1400, 100, discarded, used, 2, {0, 0.2}, {1, -1}, {0, 0.125}, 0.5};
    return facts;
}

// Steps 150 (phase pi) and 200 (phase 0) of 100 per cycle are in cycle 2.
TEST_F(Snapshots, MakeProfiles) {
    write("profiles.0.txt", head + snapshot(50) + snapshot(150) + snapshot(200));
    Profiles const profiles = layer_profiles(read(), profile_facts(1, 2));
    EXPECT_EQ(profiles.phase, (std::vector<double>{0, 0, std::numbers::pi, std::numbers::pi}));
    EXPECT_EQ(profiles.height, (std::vector<double>{1.5, 2.5, 1.3, 2.3}));
    EXPECT_EQ(profiles.solid_fraction, (std::vector<double>{0.5, 0.25, 0.5, 0.25}));
    EXPECT_EQ(profiles.velocity_x, (std::vector<double>{199, 399, 151, 301}));
    EXPECT_EQ(profiles.velocity_z, (std::vector<double>{0.5, 0.25, 0.375, 0.125}));
    // Thirds of the mass lie within the bins, of which one has twice that of the other: (400 - 200 + 300 -
    // 150) / 2 over 0.5.
    EXPECT_NEAR(profiles.velocity_gradient.value(), 350, 1e-10);
    ProfileFacts still = profile_facts(1, 2);
    still.conveying_speed = 0.001;
    EXPECT_FALSE(layer_profiles(read(), still).velocity_gradient);
    EXPECT_TRUE(layer_profiles(read(), profile_facts(2, 9)).phase.empty());
}

// Thirty fines of 300 kg/m^3 below ten coarse grains of 600 kg/m^3: the upper third of the mass is coarse, at
// 4 m/s, and the lower third fine, at 1 m/s; a third of the number of grains would have fines in both. 3 over
// the conveying speed of 0.5 m/s; tolerance: roundings.
TEST(Profiles, ThirdsAreOfTheMass) {
    Snapshot const segregated{150, {{1.5, 30, 300, {1, 0}}, {2.5, 10, 600, {4, 0}}}};
    EXPECT_NEAR(layer_profiles({segregated}, profile_facts(1, 2)).velocity_gradient.value(), 6, 1e-12);
}

// h = 0.01 + 0.002 sin(2 pi i / 8): the mean height of a column is half of it; s^2 = A^2/2 * 8/7.
TEST(Surface, HasTheAmplitudeOfItsWave) {
    Snapshot one{150, {}};
    for (int i = 0; i < 8; ++i) {
        double const height = 0.01 + 0.002 * std::sin(2 * std::numbers::pi * i / 8);
        one.bins.push_back({0.001 * i, 60, 500, {height / 2}});
    }
    Snapshot holed = one;
    holed.bins.push_back({0.1, 0, 0, {0}});  // the height of a column without grains is undefined
    for (Snapshot const& snapshot : {one, holed}) {
        Surface const surface = layer_surface({snapshot}, profile_facts(1, 2));
        EXPECT_NEAR(surface.wiggle_amplitude.value(), 0.002 * std::sqrt(8.0 / 7), 1e-12);
        EXPECT_NEAR(surface.height[2], 0.012, 1e-12);
        EXPECT_EQ(surface.x[2], 0.002);
    }
    EXPECT_TRUE(std::isnan(layer_surface({holed}, profile_facts(1, 2)).height.back()));
    EXPECT_FALSE(layer_surface({}, profile_facts(1, 2)).wiggle_amplitude);
}

}  // namespace
}  // namespace vibrotrough::measure
