#include "run_program.hpp"

#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough {
namespace {

std::string const shaken = "theory friction --machine-number 1.5 --friction ";

// FROM:TO:COUNT prints the curve, of which each line is what the command says of one friction.
TEST(TheoryFriction, PrintsTheCurve) {
    Answer const answer = run_program(shaken + "0.1:0.5:3");
    EXPECT_EQ(answer.exit_code, 0);
    std::istringstream lines(answer.text);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "friction,max_relative_displacement,mode");
    for (char const* friction : {"0.1", "0.3", "0.5"}) {
        auto const one =
            nlohmann::json::parse(run_program(shaken + friction + " --json", StandardError::dropped).text);
        std::string mu, displacement;
        std::getline(lines, mu, ',');
        std::getline(lines, displacement, ',');
        std::getline(lines, line);
        EXPECT_NEAR(std::stod(mu), std::stod(friction), 1e-12);
        EXPECT_NEAR(std::stod(displacement), one.at("max_relative_displacement"), 1e-6);
        EXPECT_EQ(line, one.at("mode").get<std::string>());
    }
    EXPECT_FALSE(std::getline(lines, line));
    Answer const refused = run_program(shaken + "0.1:0.5");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.text.find("a curve needs FROM:TO:COUNT"), std::string::npos) << refused.text;
}

}  // namespace
}  // namespace vibrotrough
