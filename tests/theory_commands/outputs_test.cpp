#include "core/temporary_folder.hpp"
#include "run_program.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

namespace fs = std::filesystem;

/// The rule of all outputs: no file of a person is replaced without --force, none that is read at all, and
/// what this program wrote may be written again.
class Outputs : public testing::Test {
  protected:
    std::string path(std::string const& name) const { return (folder_.path() / name).string(); }
    void expect_rule(std::string const& command, std::string const& file) const {
        auto const call = [&](char const* more) { return run_program(command + more); };
        std::ofstream(path(file)) << "mine\n";
        Answer const refused = call("");
        EXPECT_EQ(refused.exit_code, 2) << command << refused.text;
        EXPECT_NE(refused.text.find("--force"), std::string::npos) << refused.text;
        EXPECT_EQ(content(file), "mine\n") << command;
        EXPECT_LE(call(" --force").exit_code, 1) << command;
        EXPECT_NE(content(file), "mine\n") << command;
        Answer const again = call("");
        EXPECT_LE(again.exit_code, 1) << again.text;
    }
    static void expect_refused(std::string const& command, std::string const& words) {
        Answer const answer = run_program(command);
        EXPECT_EQ(answer.exit_code, 2) << command << answer.text;
        EXPECT_NE(answer.text.find(words), std::string::npos) << answer.text;
    }
    std::string content(std::string const& file) const {
        std::ifstream stream(path(file));
        return {std::istreambuf_iterator<char>(stream), {}};
    }

  private:
    core::TemporaryFolder const folder_;
};

TEST_F(Outputs, ReplaceOnlyWhatThisProgramWrote) {
    std::ofstream(path("in.csv")) << "throw_number,vibration_angle_deg,friction\n2,30,0.3\n";
    std::ofstream(path("speeds.csv"))
        << "frequency_hz,stroke_mm,vibration_angle_deg,speed_m_per_s\n15,8,30,0.1\n16,8,30,0.11\n";
    for (char const* const file : {"out.csv", "out.h5"})
        expect_rule("theory batch " + path("in.csv") + " --output " + path(file), file);
    expect_rule(
        "theory trace --throw-number 2 --vibration-angle '30 deg' --friction 0.3 --output " + path("t.csv"),
        "t.csv");
    std::string const map =
        "theory map --x throw_number=1:3:5 --y friction=0.2:0.4:5 --vibration-angle '30 deg' --output " +
        path("m.h5");
    expect_rule(map, "m.h5");
    if (fs::exists(path("m.vti")))
        for (char const* const file : {"m.vti", "m_modes.vtp"}) expect_rule(map, file);
    std::string const calibrate = "theory calibrate " + path("speeds.csv") +
                                  " --free friction --uncertainty 0.03 --without-discrepancy";
    expect_rule(calibrate + " --posterior " + path("p.json"), "p.json");
    std::string const design =
        "design --mass-flow '12 t/h' --bulk-density '600 kg/m3' --width '300 mm' --friction 0.3 --rpm 960 "
        "--grain-diameter '3 mm' --campaign " +
        path("c.toml");
    expect_rule(design, "c.toml");
    std::ofstream(path("c.toml"), std::ios::app) << "# edited\n";
    EXPECT_EQ(run_program(design).exit_code, 2) << "a campaign is made to be edited";
    for (std::string const& over :
         {"theory batch " + path("in.csv") + " --output " + path("in.csv"),
          calibrate + " --posterior " + path("speeds.csv"), calibrate + " --page " + path("./speeds.csv")}) {
        Answer const answer = run_program(over + " --force");
        EXPECT_EQ(answer.exit_code, 2) << over << answer.text;
        EXPECT_NE(answer.text.find("this command reads this file"), std::string::npos) << answer.text;
    }
}

// A tangent repeats after half a turn: 210 degrees would be answered like 30, and a trough upside down like a
// level one.
TEST_F(Outputs, AnglesHaveOneRange) {
    for (char const* const angles : {"210,0", "390,0", "-330,0", "90,0", "30,180", "30,-90"}) {
        std::ofstream(path("in.csv"))
            << "throw_number,friction,vibration_angle_deg,inclination_deg\n2,0.3," << angles << '\n';
        expect_refused("theory batch " + path("in.csv") + " --output " + path("out.csv"), "_deg = ");
    }
    expect_refused(
        "theory map --x throw_number=1:3:3 --y vibration_angle_deg=200:210:3 --friction 0.3 --output " +
            path("map.h5"),
        "vibration_angle_deg = ");
    expect_refused(
        "theory map --x throw_number=1:3:3 --y inclination_deg=100:180:3 --tan-vibration-angle 0.5 "
        "--friction 0.3 "
        "--output " +
            path("map.h5"),
        "inclination_deg = ");
}

// The same slopes as tangents: 45 degrees is 1.
TEST_F(Outputs, SlopesHaveOneRange) {
    auto const batch = [&](char const* slope) {
        std::ofstream(path("in.csv"))
            << "throw_number,friction,vibration_angle_deg,tan_inclination\n2,1.5,30," << slope << '\n';
        return "theory batch " + path("in.csv") + " --output " + path("out.csv");
    };
    std::string const told = " is outside its range [-1, 1]";
    for (char const* const slope : {"1.01", "-1.01", "5"})
        expect_refused(batch(slope), "tan_inclination = " + std::string(slope) + told);
    for (char const* const slope : {"1", "-1"}) EXPECT_EQ(run_program(batch(slope)).exit_code, 0) << slope;
    expect_refused(
        "theory map --x throw_number=1:3:3 --y tan_inclination=0:1.5:4 --tan-vibration-angle 0.5 "
        "--friction 0.3 --output " +
            path("map.h5"),
        "tan_inclination = 1.5" + told);
}

}  // namespace
}  // namespace vibrotrough
