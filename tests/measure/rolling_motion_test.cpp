#include "measure/rolling_motion.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

constexpr int steps_per_cycle = 300;

std::string const header =
    "step,loaded,sliding,friction,torque,contacts,all_contacts,first,first_vx,first_spin,second,second_vx,"
    "second_spin,first_volume,second_volume,floor_x,floor_z,floor_torque\n";

core::TextFile file_of(std::string const& text) {
    return {"rolling.csv", text};
}

/// A layer of 10 grains, of which 4 touch the floor at hundredth h = 0, 1 ... with v = 3 + cycle, omega R =
/// 2; the trough moves with 1 m/s.
PhaseSeries phases_of(int cycles) {
    PhaseSeries phases;
    for (int h = 0; h < 100 * cycles; ++h) {
        phases.x.push_back(0);
        phases.touching.push_back(4);
        phases.touching_vx.push_back(4 * (3.0 + h / 100));
        phases.touching_spin.push_back(4 * 2);
    }
    return phases;
}

/// Lines of as many cycles, in which `sliding` is the number of the cycle.
std::string lines_of(int cycles) {
    std::string text = "# SI units\n" + header + "# driven from here\n";
    for (int line = 1; 3 * line <= 100 * cycles; ++line) {
        int const cycle = (3 * line - 1) / 100;
        text += fmt::format("{},8,{},0.3,0.05,12,28,5,20,10,4,12,2,6e-9,8e-9,-0.2,2,0.01\n", 9 * line, cycle);
    }
    return text;
}

RollingFacts rolling_facts(int discarded, int used) {
    return {10, 1e-8, discarded, used, std::vector<double>(100, 1.0)};
}

TEST(RollingFile, IsRead) {
    RollingSeries const series = parse_rolling(file_of(lines_of(6)), steps_per_cycle);
    ASSERT_EQ(series.lines(), 200u);
    EXPECT_EQ(series.loaded[0], 8);
    EXPECT_EQ(series.all_contacts[0], 28);
    EXPECT_EQ(series.second_spin[0], 2);
    EXPECT_EQ(series.first_volume[0], 6e-9);
    EXPECT_EQ(series.floor_torque[199], 0.01);
}

TEST(RollingFile, IsRefusedWhenDamaged) {
    auto const error_of = [](std::string const& text) -> std::string {
        try {
            parse_rolling(file_of(text), steps_per_cycle);
        } catch (core::InputError const& error) {
            return error.what();
        }
        return "no error";
    };
    std::string const whole = lines_of(3);
    EXPECT_EQ(error_of(whole), "no error");
    EXPECT_EQ(error_of(whole.substr(0, whole.size() - 5)), "no error")
        << "the engine may be writing this line";
    auto const replaced = [&](std::string const& from, std::string const& to) {
        std::string text = whole;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_THAT(error_of(replaced("step,", "stop,")),
                testing::HasSubstr("is no table of contacts at the floor"));
    for (auto const& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"\n18,", "\n19,"}, {"\n18,", "\n9,"}, {"0.3,", "x,"}, {",0.01\n", "\n"}}) {
        EXPECT_THAT(error_of(replaced(from, to)), testing::HasSubstr("expected 18 numbers for step")) << to;
    }
}

// Sums over grains become means over grains; the cycles before the second are left out, and each hundredth of
// the cycle is seen in one of the three that are left: in hundredth h = 3 i - 1 of the run.
TEST(RollingCurves, AreMeansOverTheCyclesKept) {
    RollingSeries const series = parse_rolling(file_of(lines_of(5)), steps_per_cycle);
    RollingCurves const curves = rolling_curves(series, phases_of(5), rolling_facts(2, 5));
    ASSERT_EQ(curves.phase.size(), 100u);
    EXPECT_NEAR(curves.phase[24], std::acos(-1) / 2, 1e-15);
    for (std::size_t j = 0; j < 100; ++j) {
        EXPECT_EQ(curves.floor_grains[j], 4);
        EXPECT_NEAR(curves.floor_velocity[j], (5 + 6 + 7) / 3.0 - 1, 1e-12);
        EXPECT_EQ(curves.floor_spin[j], 2);
        EXPECT_NEAR(curves.floor_slip[j], 5 - 2, 1e-12);
        EXPECT_EQ(curves.first_grains[j], 5);
        EXPECT_EQ(curves.first_velocity[j], 20 / 5 - 1);
        EXPECT_EQ(curves.first_spin[j], 2);
        EXPECT_EQ(curves.second_velocity[j], 12 / 4 - 1);
        EXPECT_EQ(curves.second_spin[j], 0.5);
        EXPECT_EQ(curves.floor_contacts[j], 8);
        // Of 2, 3 and 4 the number of the one cycle that has a line at this phase.
        std::size_t cycle = 2;
        while ((100 * cycle + j) % 3 != 2) ++cycle;
        EXPECT_EQ(curves.sliding_share[j], static_cast<double>(cycle) / 8) << j;
        EXPECT_EQ(curves.normal_force[j], 2);
        EXPECT_EQ(curves.tangential_force[j], 0.2);
        EXPECT_EQ(curves.friction[j], 0.3);
        EXPECT_EQ(curves.floor_torque[j], 0.01);
        EXPECT_NEAR(curves.grain_torque[j], 0.04, 1e-15);
        EXPECT_EQ(curves.contacts_per_floor_grain[j], 3);
        EXPECT_NEAR(curves.contacts_per_grain[j], 2.8 + 0.4, 1e-15);
        EXPECT_NEAR(curves.coordination_number.value(), 2.8 + 0.4, 1e-13);  // a sum of 100 doubles
        EXPECT_NEAR(curves.first_fraction[j], 0.6, 1e-15);
        EXPECT_NEAR(curves.second_fraction[j], 0.2, 1e-15);
    }
}

TEST(RollingCurves, HaveGapsWhereNothingWasSeen) {
    PhaseSeries phases = phases_of(3);
    for (std::size_t cycle = 0; cycle < 3; ++cycle) phases.touching[100 * cycle + 7] = 0;
    RollingSeries series = parse_rolling(file_of(lines_of(3)), steps_per_cycle);
    std::fill(series.loaded.begin(), series.loaded.end(), 0);
    // Two cycles are kept: a third of the phases has no line.
    RollingCurves const curves = rolling_curves(series, phases, rolling_facts(1, 3));
    EXPECT_TRUE(std::isnan(curves.floor_velocity[7]) && std::isnan(curves.floor_slip[7]));
    EXPECT_EQ(curves.floor_grains[7], 0);
    EXPECT_TRUE(std::isnan(curves.sliding_share[8]));
    auto const gaps = std::count_if(curves.normal_force.begin(), curves.normal_force.end(),
                                    [](double force) { return std::isnan(force); });
    EXPECT_EQ(gaps, 33);
    EXPECT_TRUE(rolling_curves(series, phases, rolling_facts(1, 1)).phase.empty()) << "no cycle is kept";
}

TEST(RollingCurves, RefuseASeriesThatIsTooShort) {
    RollingSeries const series = parse_rolling(file_of(lines_of(4)), steps_per_cycle);
    EXPECT_NO_THROW(rolling_curves(series, phases_of(4), rolling_facts(1, 4)));
    try {
        rolling_curves(series, phases_of(5), rolling_facts(1, 5));
        FAIL() << "the last cycle is missing";
    } catch (core::InputError const& error) {
        EXPECT_STREQ(error.what(), "rolling.csv holds 133 lines and should hold 166 for 5 cycles");
    }
}

}  // namespace
}  // namespace vibrotrough::measure
