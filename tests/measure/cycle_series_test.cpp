#include "measure/cycle_series.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

class CyclesFile : public testing::Test {
  protected:
    CycleSeries read(std::string const& text) {
        std::ofstream(path) << text;
        return read_cycles(path, 100, 50);
    }
    std::string error_of(std::string const& text) {
        try {
            read(text);
        } catch (core::InputError const& error) {
            return error.what();
        }
        return "no error";
    }

    core::TemporaryFolder const folder;
    std::filesystem::path path = folder.path() / "cycles.csv";
    std::string const whole =
        "# SI units\nstep,grains,x_com,z_com,vz_com,mean_vx,mean_force_x,mean_force_z,flight_fraction\n"
        "0,50,0.01,0.005,0,0,0,0,0\n# driven from here\n"
        "100,50,0.02,0.006,0.1,0.12,-0.5,-9,0.25\n200,50,0.04,0.006,0.1,0.22,0.5,-10,0.5\n";
};

// Displacements of 0.01 and 0.02 m in cycles of 0.1 s are 0.1 and 0.2 m/s, beside means of 0.12 and 0.22.
TEST_F(CyclesFile, BothSpeedsAreCompared) {
    CycleSeries series = read(whole);
    std::vector<double> const durations(2, 0.1);
    EXPECT_NEAR(difference_of_speeds(series, durations), 0.02, 1e-12);
    series.x.back() *= 2;
    EXPECT_NEAR(difference_of_speeds(series, durations), 0.38, 1e-12);
}

// A layer moves by 1.5 lengths of its box of 0.1 m in each cycle of 1 s, x_k = 0.15 k. LIGGGHTS counts
// crossings of each grain up to 511: its grains, of which a tenth is 5 % faster, jump back by 1024 lengths
// after 325 and 341 cycles, and the centre of mass by a tenth and nine tenths of 102.4 m. The mean velocity
// does not.
TEST(CycleSeriesOfALongWay, HasNoJumps) {
    CycleSeries series;
    for (int k = 0; k <= 500; ++k)
        series.x.push_back(0.15 * k - (k > 325 ? 10.24 : 0) - (k > 341 ? 92.16 : 0));
    series.mean_velocity.assign(500, 0.15);
    std::vector<double> const durations(500, 1);
    CycleSeries const whole = without_jumps(series, 0.1, durations, 1e-3);
    for (std::size_t k = 0; k <= 500; ++k) ASSERT_NEAR(whole.x[k], 0.15 * static_cast<double>(k), 1e-9);
    // Negative control: in a box so long that the layer has not crossed it often, a jump is a damaged file.
    EXPECT_EQ(without_jumps(series, 1, durations, 1e-3).x, series.x);
}

TEST_F(CyclesFile, WhatIsNotFiniteIsSeen) {
    CycleSeries series = read(whole);
    EXPECT_TRUE(is_finite(series));
    for (auto* const list : {&series.x, &series.mean_velocity, &series.normal_force}) {
        double const before = list->front();
        list->front() = std::nan("");
        EXPECT_FALSE(is_finite(series));
        list->front() = before;
    }
}

// A mixture has two columns more for each material; without them the file is one of another layer.
TEST_F(CyclesFile, AMixtureHasTheCentresOfItsMaterials) {
    std::string const text =
        "step,grains,x_com,z_com,vz_com,mean_vx,mean_force_x,mean_force_z,flight_fraction,x_0,z_0,x_1,z_1\n"
        "0,50,0.01,0.005,0,0,0,0,0,0.01,0.004,0.011,0.007\n"
        "100,50,0.02,0.006,0.1,0.12,-0.5,-9,0.25,0.02,0.005,0.022,0.008\n";
    std::ofstream(path) << text;
    CycleSeries const series = read_cycles(path, 100, 50, 2);
    EXPECT_EQ(series.materials[0].z, (std::vector<double>{0.004, 0.005}));
    EXPECT_EQ(series.materials[1].x, (std::vector<double>{0.011, 0.022}));
    EXPECT_TRUE(series.materials[2].x.empty());
    EXPECT_EQ(first_cycles(series, 0).materials[1].z, (std::vector<double>{0.007}));
    EXPECT_THROW(read_cycles(path, 100, 50, 3), core::InputError);
    EXPECT_THROW(read_cycles(path, 100, 50), core::InputError);
}

TEST_F(CyclesFile, IsRead) {
    CycleSeries const series = read(whole);
    EXPECT_EQ(series.cycles(), 2);
    EXPECT_EQ(series.x, (std::vector<double>{0.01, 0.02, 0.04}));
    EXPECT_EQ(series.z, (std::vector<double>{0.005, 0.006, 0.006}));
    EXPECT_EQ(series.vz, (std::vector<double>{0, 0.1, 0.1}));
    EXPECT_EQ(series.mean_velocity, (std::vector<double>{0.12, 0.22}));
    EXPECT_EQ(series.tangential_force, (std::vector<double>{-0.5, 0.5}));
    EXPECT_EQ(series.normal_force, (std::vector<double>{9, 10}));  // pressing is positive
    EXPECT_EQ(series.flight_fraction, (std::vector<double>{0.25, 0.5}));
    CycleSeries const first = first_cycles(series, 1);
    EXPECT_EQ(first.cycles(), 1);
    EXPECT_EQ(first.x.size(), 2u);
    EXPECT_EQ(first.vz.size(), 2u);
    // W = <F_z> - m (v_z(n) - v_z(0)) / (n T) = 9.5 - 2 * 0.1 / (2 * 0.5)
    EXPECT_NEAR(weight_by_momentum(series, 2, 0.5), 9.3, 1e-12);
}

// The file is read while the engine writes it: at any time the complete lines are read and the rest is left
// out.
TEST_F(CyclesFile, IsReadAtAnyMoment) {
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        CycleSeries const series = read(whole.substr(0, size));
        EXPECT_LE(series.cycles(), 2);
        EXPECT_TRUE(series.x.empty() || series.x.size() == static_cast<std::size_t>(series.cycles()) + 1);
    }
}

TEST_F(CyclesFile, IsRefusedWhenDamaged) {
    auto const replaced = [&](std::string const& from, std::string const& to) {
        std::string text = whole;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_NE(error_of(replaced("step,", "stop,")).find(":2: is no table of cycles"), std::string::npos);
    for (auto const& [from, to] : std::vector<std::pair<std::string, std::string>>{{"200,50", "300,50"},
                                                                                   {"100,50", "x,50"},
                                                                                   {"-9,0.25", "-9"},
                                                                                   {"-9,0.25", "-9,0.25,1"},
                                                                                   {"-9,0.25", "-9;0.25"}}) {
        EXPECT_NE(error_of(replaced(from, to)).find("the line is damaged"), std::string::npos) << to;
    }
    EXPECT_NE(error_of(replaced("200,50", "200,49")).find(":6: 49 grains instead of 50"), std::string::npos);
    EXPECT_THROW(read_cycles("no-such-file", 1, 1), core::MissingError);
}

}  // namespace
}  // namespace vibrotrough::measure
