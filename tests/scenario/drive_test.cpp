#include "scenario/model/drive.hpp"

#include "core/temporary_folder.hpp"
#include "example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

constexpr double pi = std::numbers::pi;

// X'' = - omega^2 r cos(beta) (sin t + a sin(k t + phase)), so X = r cos(beta) (sin t + a / k^2 sin(k t +
// phase)).
TEST(Drive, HarmonicsAreOfAcceleration) {
    scenario::Scenario const s =
        scenario_of(with("throw_number = 2.0", "throw_number = 2.0\nharmonics = [\"5, 0.25, 90 deg\"]"));
    scenario::DriveMotion const motion = drive_motion(s.trough);
    ASSERT_EQ(motion.along.size(), 2u);
    EXPECT_NEAR(motion.along[0].amplitude, 6e-3 * std::cos(pi / 6), 1e-15);
    EXPECT_NEAR(motion.along[1].amplitude, 6e-3 * std::cos(pi / 6) * 0.25 / 25, 1e-15);
    EXPECT_NEAR(motion.normal[1].amplitude, 6e-3 * std::sin(pi / 6) * 0.01, 1e-15);
    EXPECT_NEAR(motion.normal[1].phase, pi / 2, 1e-15);
    EXPECT_EQ(highest_order(motion), 5);
    EXPECT_NEAR(largest_speed(motion, 10), 10 * 6e-3 * (1 + 0.25 / 5), 1e-12);
    EXPECT_NEAR(largest_excursion(motion), 6e-3 * 1.01, 1e-12);
}

TEST(Drive, AlongPhaseMakesAnEllipse) {
    scenario::DriveMotion const motion = drive_motion(
        scenario_of(with("throw_number = 2.0", "throw_number = 2.0\nalong_phase = \"20 deg\"")).trough);
    EXPECT_NEAR(motion.along[0].phase, pi / 9, 1e-15);
    EXPECT_EQ(motion.normal[0].phase, 0);
}

std::string samples(int count, double period, double spoilt = 0) {
    std::string text = "# a shaker\ntime_s,x_m,z_m\n";
    for (int i = 0; i < count; ++i) {
        double const t = 2 * pi * i / count;
        text +=
            fmt::format("{},{},{}\n", period * i / count + (i == 3 ? spoilt : 0),
                        0.001 + 5e-3 * std::sin(t + 0.3) + 1e-4 * std::sin(4 * t - 1), 3e-3 * std::sin(t));
    }
    return text;
}

// The discrete Fourier series of a sum of sines below half the sampling frequency is that sum: to rounding.
TEST(Drive, WaveformBecomesItsFourierSeries) {
    scenario::DriveMotion const motion = scenario::read_waveform({"w.csv", samples(16, 0.1)})->motion;
    ASSERT_EQ(motion.along.size(), 2u);
    EXPECT_NEAR(motion.along[0].amplitude, 5e-3, 1e-15);
    EXPECT_NEAR(motion.along[0].phase, 0.3, 1e-12);
    EXPECT_EQ(motion.along[1].order, 4);
    EXPECT_NEAR(motion.along[1].amplitude, 1e-4, 1e-15);
    EXPECT_NEAR(motion.along[1].phase, -1, 1e-11);
    ASSERT_EQ(motion.normal.size(), 1u);
    EXPECT_NEAR(motion.normal[0].amplitude, 3e-3, 1e-15);
}

TEST(Drive, WaveformMistakesAreNamed) {
    auto const error_of = [](std::string const& text) -> std::string {
        try {
            scenario::read_waveform({"w.csv", text});
        } catch (std::invalid_argument const& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_NE(error_of("t,x,z\n").find("line 1: 't' is not a known column"), std::string::npos);
    EXPECT_EQ(error_of("time_s,x_m,z_m\n0,1\n"), "line 2: expected 3 values, one per column, but found 2");
    EXPECT_EQ(error_of("time_s,x_m,z_m\n0,0,nan\n"), "line 2: column z_m: 'nan' is not a finite number");
    EXPECT_EQ(error_of(samples(7, 0.1)), "there are 7 samples, but at least 8 are needed");
    EXPECT_NE(error_of(samples(16, 0.1, 0.001)).find("sample 4 is at"), std::string::npos);
    EXPECT_EQ(error_of("time_s,x_m,z_m\n0,0,0\n0.0125,0,0\n0.025,0,0\n0.0375,0,0\n0.05,0,0\n0.0625,0,0\n"
                       "0.075,0,0\n0.0875,0,0\n"),
              "the trough does not move");
}

// What is not given follows from the file. Keys that are near it are nominal values; others are a mistake.
TEST(Drive, WaveformHasItsOwnAmplitudeAndAngle) {
    core::TemporaryFolder const own_folder;
    std::filesystem::path const& folder = own_folder.path();
    std::ofstream(folder / "shaker.csv") << samples(32, 0.1);
    auto const read = [&](std::string const& drive) {
        std::string const text = with("amplitude = \"6 mm\"\nthrow_number = 2.0", drive,
                                      with("vibration_angle = \"30 deg\"\n", ""));
        return scenario::parse_campaign(text, "c.toml", {folder, {}}).cases.front();
    };
    std::string const file = "frequency = \"10 Hz\"\nwaveform = \"shaker.csv\"\n";
    try {
        read("amplitude = \"9 mm\"\nvibration_angle = \"30 deg\"\n" + file);
        FAIL() << "an amplitude that is not the waveform's was taken";
    } catch (std::exception const& error) {
        EXPECT_NE(std::string(error.what())
                      .find("write amplitude = \"5.83095 mm\", vibration_angle = \"30.964 deg\""),
                  std::string::npos)
            << error.what();
    }
    scenario::Scenario const s =
        read("amplitude = \"5.83095 mm\"\nvibration_angle = \"30.964 deg\"\n" + file);
    EXPECT_EQ(drive_motion(s.trough).along.size(), 2u);
    for (char const* keys : {"waveform = \"shaker.csv\"\n",
                             "amplitude = \"6 mm\"\nvibration_angle = \"30 deg\"\nfrequency = \"10 Hz\"\n"
                             "waveform = \"shaker.csv\"\n"}) {
        scenario::Trough const trough = read(keys).trough;
        EXPECT_NEAR(trough.amplitude, std::hypot(5e-3, 3e-3), 1e-12);
        EXPECT_NEAR(trough.vibration_angle, std::atan2(3, 5), 1e-9);
        EXPECT_NEAR(trough.frequency, 10, 1e-9);
    }
    EXPECT_EQ(highest_order(drive_motion(read("waveform = \"shaker.csv\"\nwaveform_order = 3\n").trough)), 1);
}

// The theory has harmonics of up to 1000 times the acceleration of the fundamental. Everything that is wrong
// is told at once.
TEST(Drive, AWaveformWithASmallFundamentalIsRefused) {
    std::string text = "time_s,x_m,z_m\n";
    for (int i = 0; i < 64; ++i) {
        double const t = 2 * pi * i / 64;
        text += fmt::format("{},{},{}\n", 0.1 * i / 64, 5e-3 * std::sin(t),
                            1e-6 * std::sin(t) + 1e-3 * std::sin(3 * t));
    }
    scenario::Trough trough = scenario_of(with("throw_number = 2.0", "frequency = \"20 Hz\"")).trough;
    auto const fault = find_fault(*scenario::read_waveform({"w.csv", text}), trough);
    ASSERT_TRUE(fault);
    for (char const* const part :
         {"frequency is 10 Hz", "differ from the keys", "normal to the trough", "order 3"})
        EXPECT_NE(fault->wrong.find(part), std::string::npos) << part << " in " << fault->wrong;
    EXPECT_NE(fault->instead.find("frequency = \"10 Hz\""), std::string::npos) << fault->instead;
}

}  // namespace
}  // namespace vibrotrough
