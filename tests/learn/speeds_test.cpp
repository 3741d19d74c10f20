#include "learn/speeds.hpp"

#include "core/csv.hpp"
#include "learn/machine_keys.hpp"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

// r = stroke / 2; f = rpm / 60.
TEST(Speeds, StrokeAndRevolutions) {
    auto const speeds = read_speeds(
        "speed_m_per_s,rpm,stroke_mm,vibration_angle_deg,inclination_deg,uncertainty_m_per_s\n"
        "0.2,600,6,30,-5,0.01\n",
        "speeds.csv");
    ASSERT_EQ(speeds.size(), 1U);
    EXPECT_DOUBLE_EQ(speeds[0].amplitude, 0.003);
    EXPECT_DOUBLE_EQ(speeds[0].frequency, 10);
    EXPECT_DOUBLE_EQ(*speeds[0].vibration_angle, 30 * degree);
    EXPECT_DOUBLE_EQ(*speeds[0].inclination, -5 * degree);
    EXPECT_DOUBLE_EQ(speeds[0].speed, 0.2);
    EXPECT_DOUBLE_EQ(speeds[0].uncertainty, 0.01);
    EXPECT_EQ(speeds[0].line, 2);
}

// What a spreadsheet of a country with decimal commas saves: byte order mark, semicolons, CR LF.
TEST(Speeds, SemicolonsAndDecimalCommas) {
    auto const speeds = read_speeds(
        "\xEF\xBB\xBF"
        "amplitude_mm;frequency_hz;vibration_angle_deg;speed_m_per_s;uncertainty_m_per_s\r\n"
        "1,25;21,15;30;0,0601;0,0011\r\n\r\n",
        "speeds.csv");
    ASSERT_EQ(speeds.size(), 1U);
    EXPECT_DOUBLE_EQ(speeds[0].amplitude, 0.00125);
    EXPECT_DOUBLE_EQ(speeds[0].frequency, 21.15);
    EXPECT_DOUBLE_EQ(speeds[0].speed, 0.0601);
    EXPECT_FALSE(speeds[0].inclination);
}

TEST(Speeds, MetresPerMinute) {
    auto const speeds =
        read_speeds("stroke_mm\trpm\tspeed_m_per_min\tuncertainty_m_per_min\n9\t960\t12\t0,6\n", "t.csv");
    ASSERT_EQ(speeds.size(), 1u);
    EXPECT_DOUBLE_EQ(speeds[0].speed, 0.2);
    EXPECT_DOUBLE_EQ(speeds[0].uncertainty, 0.01);
}

TEST(Speeds, RelativeUncertaintyFillsEmptyCells) {
    auto const speeds = read_speeds(
        "amplitude_mm,rpm,speed_m_per_s,uncertainty_m_per_s\n3,600,-0.2,\n3,600,0.2,0.04\n", "", 0.1);
    EXPECT_DOUBLE_EQ(speeds[0].uncertainty, 0.02);
    EXPECT_DOUBLE_EQ(speeds[1].uncertainty, 0.04);
}

void expect_refused(std::string const& text, std::string const& words) {
    try {
        read_speeds(text, "speeds.csv");
        ADD_FAILURE() << text;
    } catch (core::CsvError const& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(words));
        EXPECT_THAT(error.what(), testing::HasSubstr("speeds.csv:"));
    }
}

TEST(Speeds, SlipsOfUnitsAreTold) {
    auto const told = [](char const* row) {
        std::string text;
        std::string const table =
            std::string("stroke_mm,rpm,vibration_angle_deg,speed_m_per_s\n") + row + "\n";
        for (std::string const& sentence : unusual_speeds(read_speeds(table, "t.csv", 0.03)))
            text += sentence + "\n";
        return text;
    };
    EXPECT_EQ(told("9.7,960,30,0.2"), "");
    EXPECT_THAT(told("9.7,960,30,12"), testing::HasSubstr("line 2: a speed of 12 m/s is more than"));
    // Only a slip that explains the number is offered.
    EXPECT_THAT(told("9.7,960,30,12"), testing::HasSubstr("were m/min meant"));
    EXPECT_THAT(told("9.7,960,30,200"), testing::HasSubstr("were mm/s meant?"));
    EXPECT_THAT(told("9.7,960,30,900"), testing::Not(testing::HasSubstr("meant")));
    EXPECT_THAT(told("0.0097,960,30,0.2"), testing::HasSubstr("written in m, not mm?"));
    EXPECT_THAT(told("9.7,16,30,0.005"), testing::HasSubstr("were 16 Hz meant, not rpm?"));
    EXPECT_THAT(told("9.7,960,0.52,0.2"), testing::HasSubstr("were radians meant (29.8 degrees)?"));
}

// The typed quantity is named: a stroke is not called an amplitude, nor turns a frequency.
TEST(Speeds, SlipsNameWhatWasTyped) {
    auto const told = [](std::string const& header, std::string const& row) {
        auto const sentences = unusual_speeds(
            read_speeds(header + ",vibration_angle_deg,speed_m_per_s\n" + row + "\n", "t.csv", 0.03));
        return sentences.empty() ? "" : sentences.front();
    };
    EXPECT_THAT(told("stroke_mm,rpm", "9700,960,30,0.2"), testing::HasSubstr("a stroke of 9700 mm"));
    EXPECT_THAT(told("amplitude_mm,rpm", "9700,960,30,0.2"), testing::HasSubstr("an amplitude of 9700 mm"));
    EXPECT_THAT(told("stroke_mm,rpm", "9.7,16,30,0.005"),
                testing::HasSubstr("a speed of the drive of 16 1/min"));
    EXPECT_THAT(told("stroke_mm,frequency_hz", "9.7,960,30,0.2"),
                testing::HasSubstr("960 turns per minute meant"));
    EXPECT_THAT(told("amplitude_mm,rpm", "9.7,960,30,0.2"),
                testing::HasSubstr("was the stroke given as the amplitude"));
    expect_refused("stroke_mm,rpm,speed_m_per_s,uncertainty_m_per_s\n9.7,960,1200,1\n",
                   "speed_m_per_s: 1200 is out of range (were 1200 m/min meant?)");
}

TEST(Speeds, AnotherNameOfAColumnIsUnderstood) {
    expect_refused("stroke_mm,rpm,speed_m_per_sec\n1,2,3\n", "did you mean speed_m_per_s?");
    expect_refused("stroke_mm,rpm,colour\n1,2,3\n", "the names are");
}

TEST(Speeds, WrongTablesAreRefused) {
    std::string const good = "amplitude_mm,rpm,speed_m_per_s,uncertainty_m_per_s\n";
    expect_refused("", "empty");
    expect_refused(good, "no measurement");
    expect_refused("amplitude_mm,stroke_mm,rpm,speed_m_per_s\n1,2,3,4\n", "given both");
    expect_refused("amplitude_mm,speed_m_per_s\n1,2\n", "neither a column rpm nor frequency_hz");
    expect_refused("amplitude_mm,rpm,speed\n1,2,3\n", "'speed' is not a column");
    expect_refused("stroke_mm,rpm,speed_m_per_min,speed_m_per_s\n1,2,3,4\n", "given both");
    expect_refused("amplitude_mm,rpm\n1,2\n", "neither a column speed_m_per_s nor speed_m_per_min");
    expect_refused(good + "1,600,0.2,\n", "has no uncertainty");
    expect_refused(good + "1,600,0.2,0\n", "uncertainty_m_per_s: 0 is out of range");
    expect_refused(good + "-1,600,0.2,0.1\n", "amplitude_mm: -1 is out of range");
    expect_refused(good + "1,,0.2,0.1\n", "column rpm is empty");
    expect_refused(good + "1,600,fast,0.1\n", "'fast'");
    expect_refused(good + "1,600,0.2\n", "expected 4 values");
}

}  // namespace
}  // namespace vibrotrough::learn
