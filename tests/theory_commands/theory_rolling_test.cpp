#include "run_program.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough {
namespace {

std::string const level = "--throw-number 1.7 --tan-vibration-angle 0.5 --friction 0.23 ";

nlohmann::json solved(std::string const& words) {
    Answer const answer = run_program("theory " + words + " --json", StandardError::dropped);
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    return nlohmann::json::parse(answer.text);
}

// The published constants, by the independent integration of tests/theory: 0.673631.
TEST(TheoryRollingLayer, SolvesAPointWithThePublishedConstants) {
    auto const answer = solved("point " + level + "--rolling-layer");
    EXPECT_NEAR(answer.at("velocity_efficiency"), 0.673631, 1e-6);
    EXPECT_EQ(answer.at("mode"), "FP'N");
    EXPECT_EQ(answer.at("outside_tested_range"), false);
    auto const named =
        solved("point " + level +
               "--rolling-layer torque=0.61,dry_torque=0.02,spin_inertia=0.1,stiffness=14,damping=2.2");
    EXPECT_EQ(named.at("velocity_efficiency"), answer.at("velocity_efficiency"));
}

TEST(TheoryRollingLayer, IsThePointMassInItsLimit) {
    auto const point = solved("point " + level);
    auto const limit = solved("point " + level + "--rolling-layer torque=inf,stiffness=inf");
    EXPECT_NEAR(limit.at("velocity_efficiency"), point.at("velocity_efficiency"), 1e-9);
    EXPECT_EQ(limit.at("mode"), point.at("mode"));
}

// A throw number of 2.8 on a slope of -0.06 was once answered with 1.28 without a word.
TEST(TheoryRollingLayer, WithholdsItsAnswerOutsideItsRange) {
    std::string const words =
        "theory point --throw-number 2.8 --tan-inclination -0.06 --tan-vibration-angle 0.5 --friction 0.3 "
        "--rolling-layer ";
    Answer const answer = run_program(words);
    EXPECT_EQ(answer.exit_code, 1);
    EXPECT_NE(answer.text.find("withheld: the rolling-layer law has not been tested at throw_number = 2.8"),
              std::string::npos);
    auto const json = nlohmann::json::parse(run_program(words + "--json").text);
    EXPECT_TRUE(json.at("velocity_efficiency").is_null());
    EXPECT_EQ(json.at("outside_tested_range"), true);
    Answer const accepted = run_program(words + "--accept-untested");
    EXPECT_EQ(accepted.exit_code, 0);
    EXPECT_NE(accepted.text.find("NOT TESTED           the rolling-layer law"), std::string::npos);
    EXPECT_EQ(run_program("theory trace " + words.substr(13)).exit_code, 2);
    EXPECT_EQ(run_program("theory point " + level + "--rolling-layer").text.find("TESTED"),
              std::string::npos);
}

// Numbers that were worked out from what was typed have few digits, and an angle is in degrees.
TEST(TheoryRollingLayer, NamesPlacesWithFewDigits) {
    std::string const machine = "theory point --rpm 1234 --stroke '12 mm' --friction 0.3 --rolling-layer ";
    std::string const drive = machine + "--vibration-angle '30 deg'";
    EXPECT_NE(run_program(drive).text.find("at throw_number = 5.10669, where"), std::string::npos);
    EXPECT_NE(
        run_program(drive + " --inclination '5 deg'")
            .text.find("at tan_inclination = 0.0874887 (5 deg), outside [-0.08, 0.08] (-4.574 to 4.574 deg)"),
        std::string::npos);
    EXPECT_NE(
        run_program(machine + "--tan-vibration-angle 0.9")
            .text.find("at tan_vibration_angle = 0.9 (41.99 deg), outside [0.35, 0.75] (19.29 to 36.87 deg)"),
        std::string::npos);
    EXPECT_NE(run_program(machine + "--vibration-angle '95 deg'").text.find("between 0 and 89 deg;"),
              std::string::npos);
}

TEST(TheoryRollingLayer, RefusesWrongConstantsInOneLine) {
    for (auto const& [constants, words] : std::vector<std::pair<std::string, std::string>>{
             {"torque=-1", "torque = -1 is outside its range"},
             {"mass=2", "'mass' is not a constant; write one of torque"},
             {"torque", "needs NAME=VALUE"},
             {"torque=soft", "torque"}}) {
        Answer const answer = run_program("theory point " + level + "--rolling-layer " + constants);
        EXPECT_EQ(answer.exit_code, 2) << constants;
        EXPECT_NE(answer.text.find(words), std::string::npos) << answer.text;
        EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
    }
    Answer const extended = run_program("theory point " + level + "--restitution 0.2 --rolling-layer");
    EXPECT_EQ(extended.exit_code, 2);
}

// The trace has the columns of the layer; its slip is velocity minus spin.
TEST(TheoryRollingLayer, TracesSpinAndForces) {
    Answer const answer =
        run_program("theory trace " + level + "--samples 50 --rolling-layer", StandardError::dropped);
    EXPECT_EQ(answer.exit_code, 0);
    std::istringstream lines(answer.text);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "t,phase,layer_velocity,spin,slip,gap,gap_rate,normal_force,tangential_force");
    int count = 0;
    while (std::getline(lines, line)) {
        std::istringstream cells(line.substr(line.find(',', line.find(',') + 1) + 1));
        double velocity = 0, spin = 0, slip = 0;
        char comma = 0;
        cells >> velocity >> comma >> spin >> comma >> slip;
        EXPECT_NEAR(slip, velocity - spin, 1e-12);
        ++count;
    }
    EXPECT_EQ(count, 50);
}

TEST(TheoryRollingLayer, SolvesABatchAndADesign) {
    auto const folder = std::filesystem::temp_directory_path() / "vibrotrough_rolling_batch";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "points.csv")
        << "throw_number,tan_vibration_angle,friction\n1.7,0.5,0.23\n3,0.5,0.23\n";
    Answer const batch = run_program("theory batch '" + (folder / "points.csv").string() + "' --output '" +
                                     (folder / "answers.csv").string() + "' --rolling-layer");
    EXPECT_EQ(batch.exit_code, 0) << batch.text;
    EXPECT_NE(batch.text.find("warning: 1 of 2 points"), std::string::npos) << batch.text;
    std::stringstream answers;
    answers << std::ifstream(folder / "answers.csv").rdbuf();
    EXPECT_NE(answers.str().find("0.67363"), std::string::npos) << answers.str();
    EXPECT_NE(answers.str().find("3,0.5,0.23,nan,nan,,0,false"), std::string::npos) << answers.str();
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace vibrotrough
