#include "measure/phase_series.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

class PhasesFile : public testing::Test {
  protected:
    PhaseSeries read(std::string const& text) {
        std::ofstream(path) << text;
        return read_phases(path, 300);
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
    std::filesystem::path path = folder.path() / "phases.csv";
    std::string const whole =
        "# SI units\n"
        "step,x_com,z_com,vx_com,vz_com,trough_x,trough_z,force_x,force_z,floor_z,touching,touching_vx,"
        "touching_spin,"
        "clearance,energy_translation,energy_rotation,overlap\n"
        "# driven from here\n"
        "3,1,2,3,4,5,6,-7,-8,-7.5,9,10,11,12,13,14,15\n"
        "# driven from here\n"
        "6,1.5,2,3,4,5,6,-7,-8,-7.5,9,10,11,-1e-5,13,14,-1e+20\n";
};

TEST_F(PhasesFile, IsRead) {
    PhaseSeries const series = read(whole);
    ASSERT_EQ(series.lines(), 2u);
    EXPECT_EQ(series.cycles(), 0);
    EXPECT_EQ(series.x, (std::vector<double>{1, 1.5}));
    EXPECT_EQ(series.tangential_force[0], -7);
    EXPECT_EQ(series.normal_force[0], 8);  // pressing is positive
    EXPECT_EQ(series.floor_force[0], 7.5);
    EXPECT_EQ(series.touching[0], 9);
    EXPECT_EQ(series.touching_spin[0], 11);
    EXPECT_EQ(series.clearance[1], -1e-5);
    EXPECT_EQ(series.energy_rotation[1], 14);
    // Without contacts the engine writes its most negative number as the maximum.
    EXPECT_EQ(series.overlap, (std::vector<double>{15, 0}));
}

// x_1 = x_0 + (3 + 3) / 2 * 0.5
TEST_F(PhasesFile, PlacesOfRigidBodiesAreIntegrated) {
    PhaseSeries const series = with_integrated_positions(read(whole), 0.5);
    EXPECT_EQ(series.x, (std::vector<double>{1, 2.5}));
}

// The file is read while the engine writes it: at any time the complete lines are read and the rest is left
// out.
TEST_F(PhasesFile, IsReadAtAnyMoment) {
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        PhaseSeries const series = read(whole.substr(0, size));
        EXPECT_LE(series.lines(), 2u);
        EXPECT_EQ(series.lines(), series.overlap.size());
    }
}

TEST_F(PhasesFile, IsRefusedWhenDamaged) {
    auto const replaced = [&](std::string const& from, std::string const& to) {
        std::string text = whole;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_NE(error_of(replaced("step,", "stop,")).find(":2: is no table of phases"), std::string::npos);
    for (auto const& [from, to] : std::vector<std::pair<std::string, std::string>>{{"\n6,", "\n9,"},
                                                                                   {"\n6,", "\n3,"},
                                                                                   {"\n3,1", "\n3,x"},
                                                                                   {",14,15", ",14"},
                                                                                   {",14,15", ",14,15,16"},
                                                                                   {",14,15", ",14;15"}}) {
        EXPECT_NE(error_of(replaced(from, to)).find("the line is damaged; expected 17 numbers for step"),
                  std::string::npos)
            << to;
    }
    EXPECT_THROW(read_phases("no-such-file", 300), core::MissingError);
    EXPECT_THROW(read_phases(path, 250), std::invalid_argument);
}

}  // namespace
}  // namespace vibrotrough::measure
