#include "core/temporary_folder.hpp"
#include "run_program.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough {
namespace {

namespace fs = std::filesystem;

class TheoryCalibrate : public testing::Test {
  protected:
    std::string write(std::string const& text, char const* name = "speeds.csv") const {
        std::string const path = (folder_.path() / name).string();
        std::ofstream(path) << text;
        return path;
    }
    fs::path folder() const { return folder_.path(); }

  private:
    core::TemporaryFolder folder_;
};

constexpr char const* krakow =
    "amplitude_mm;rpm;vibration_angle_deg;inclination_deg;speed_m_per_s;uncertainty_m_per_s\n"
    "1,25;1269;30;2;0,0601;0,0011\n1,25;1453;30;2;0,0990;0,0029\n1,25;1558;30;2;0,1307;0,0051\n";

TEST_F(TheoryCalibrate, JsonOfTheKrakowSpeeds) {
    Answer const answer =
        run_program("theory calibrate '" + write(krakow) + "' --free friction,inclination --json",
                    StandardError::dropped);
    ASSERT_EQ(answer.exit_code, 0) << answer.text;
    auto const json = nlohmann::json::parse(answer.text);
    ASSERT_EQ(json.at("parameters").size(), 2U);
    EXPECT_EQ(json["parameters"][1].at("name"), "inclination");
    for (auto const& p : json["parameters"]) {
        for (char const* key : {"median", "low", "high", "rhat", "ess", "identifiable"})
            EXPECT_TRUE(p.contains(key)) << key;
    }
    EXPECT_EQ(json.at("measurements").size(), 3U);
    EXPECT_LT(json.at("best_fit").at("p_value").get<double>(), 0.01);
}

TEST_F(TheoryCalibrate, SaysInWordsWhatItFound) {
    Answer const answer = run_program("theory calibrate '" + write(krakow) + "' --free friction");
    EXPECT_EQ(answer.exit_code, 0);
    EXPECT_THAT(answer.text, testing::HasSubstr("No friction explains these 3 speeds by the point mass"));
    EXPECT_THAT(answer.text, testing::HasSubstr("wrong as at layers of spheres, and further by 0."));
    EXPECT_THAT(answer.text, testing::HasSubstr("hold that the point mass misses layers of spheres"));
    for (char const* const alone : {" --common-error 0", " --common-error 0.05", " --without-discrepancy"}) {
        Answer const without =
            run_program("theory calibrate '" + write(krakow) + "' --free friction" + alone);
        EXPECT_EQ(without.exit_code, 0) << without.text;
        EXPECT_THAT(without.text, testing::Not(testing::HasSubstr("layers of spheres"))) << alone;
    }
}

TEST_F(TheoryCalibrate, CornerPlot) {
    std::string const plot = (folder() / "corner.png").string();
    Answer const answer =
        run_program("theory calibrate '" + write(krakow) + "' --free friction --plot '" + plot + "'");
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    std::ifstream file(plot, std::ios::binary);
    std::string magic(4, ' ');
    file.read(magic.data(), 4);
    EXPECT_EQ(magic, "\x89PNG");
}

TEST_F(TheoryCalibrate, WrongInputsAreRefusedInOneLine) {
    std::string const file = "theory calibrate '" + write(krakow) + "' --free ";
    struct Case {
        std::string command, words;
    };
    for (Case const& one :
         {Case{file + "fricton", "choose from friction"},
          Case{file + "inclination", "the friction is not known"},
          Case{file + "friction --fix friction=0.3", "both free and fixed"},
          Case{file + "friction --prior inclination=0:1", "inclination is not free"},
          Case{file + "friction --prior friction=0.5:0.2", "below the second"},
          Case{file + "friction --prior friction=0.5", "LOW:HIGH"},
          Case{file + "friction --fix restitution", "NAME=VALUE"},
          Case{file + "friction --fix restitution=7", "at most"},
          Case{file + "friction --common-error 2", "--common-error"},
          Case{file + "friction --model atlas", "--grain-diameter \"3 mm\""},
          Case{file + "friction --grain-diameter '3 mm'", "belongs to --model atlas"},
          Case{file + "friction --model atlas --grain-diameter '3 mm' --fix depth=24",
               "the atlas has 2 to 20"},
          Case{file + "friction --model atlas --grain-diameter '0.1 mm'", "outside of the atlas"},
          Case{"theory calibrate /nowhere.csv --free friction", "/nowhere.csv"},
          Case{"theory calibrate '" + write("rpm,speed_m_per_s\n1,2\n", "other.csv") + "' --free friction",
               "neither a column stroke_mm nor amplitude_mm"}}) {
        Answer const answer = run_program(one.command);
        EXPECT_THAT(answer.exit_code, testing::AnyOf(2, 3)) << one.command;
        EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
        EXPECT_THAT(answer.text, testing::HasSubstr(one.words));
    }
}

}  // namespace
}  // namespace vibrotrough
