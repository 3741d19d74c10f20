#include "run_program.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough {
namespace {

nlohmann::json point(std::string const& options) {
    Answer const answer = run_program("theory point " + options + " --json");
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    return nlohmann::json::parse(answer.text);
}

// The contract of --json. Tolerance: the four decimals that are given.
TEST(TheoryPoint, PrintsTheContract) {
    auto const answer = point("--throw-number 2 --tan-vibration-angle 0.5 --friction 0.23");
    EXPECT_NEAR(answer.at("velocity_efficiency"), 0.5815, 5e-5);
    EXPECT_EQ(answer.at("mode"), "FN'");
    EXPECT_EQ(answer.at("period_cycles"), 1);
    EXPECT_EQ(answer.at("converged"), true);
    EXPECT_EQ(answer.at("throw_number"), 2.0);
    EXPECT_NEAR(answer.at("machine_number"), 2 * std::sqrt(5.0), 1e-12);  // K = Gamma / sin(beta)
    EXPECT_NEAR(answer.at("flight_number"), 0.7415, 5e-5);
    double displacement = 0;
    for (auto const& phase : answer.at("phases")) {
        EXPECT_LT(phase.at("start_rad"), phase.at("end_rad"));
        EXPECT_TRUE(phase.at("kind").is_string());
        displacement += phase.at("relative_displacement").get<double>();
    }
    // eta = X_rel / (2 pi). Tolerance: rounding.
    EXPECT_NEAR(displacement / (2 * std::acos(-1.0)), answer.at("velocity_efficiency"), 1e-12);
}

// What people write: a motor's turns, a percentage, German units. Tolerance: none, the input is the same.
TEST(TheoryPoint, TakesWhatPeopleWrite) {
    std::string const rest = " --amplitude \"4 mm\" --vibration-angle \"25 deg\" ";
    auto const expected = point("--frequency \"16 Hz\" --friction 0.3" + rest);
    for (char const* const same : {"--rpm 960 --friction 0.3", "--rpm \"960 rpm\" --friction \"30 %\"",
                                   "--frequency \"960 U/min\" --friction 0.3"})
        EXPECT_EQ(point(same + rest), expected) << same;
    Answer const both = run_program("theory point --rpm 960 --frequency \"16 Hz\" --friction 0.3" + rest);
    EXPECT_EQ(both.exit_code, 2);
    EXPECT_NE(both.text.find("both given"), std::string::npos) << both.text;
    Answer const comma = run_program("theory point --rpm 960 --friction 0,3" + rest);
    EXPECT_EQ(comma.exit_code, 2);
    EXPECT_NE(comma.text.find("has a decimal comma; write 0.3"), std::string::npos) << comma.text;
    Answer const range =
        run_program("theory point --rpm 960 --friction 0.3 --amplitude \"4 mm\" --vibration-angle 25-35deg");
    EXPECT_EQ(range.exit_code, 2);
    EXPECT_NE(range.text.find("is a range, and here one value is needed"), std::string::npos) << range.text;
}

// Where layers were simulated the answer says how they differ, and which command has them: the atlas ends at
// a throw number of 3.2 and at slopes of 0.1. A layer was twice as fast on the level between 1.2 and 2.3.
TEST(TheoryPoint, PromisesALayerWhereThereAreLayers) {
    std::pair<char const*, std::pair<bool, bool>> const points[] = {
        {"--throw-number 1.7 --friction 0.23", {true, true}},
        {"--throw-number 1.7 --friction 0.23 --tan-inclination -0.05", {false, true}},
        {"--throw-number 3 --friction 0.23", {false, true}},
        {"--throw-number 12 --friction 0.23", {false, false}},
        {"--throw-number 1.7 --friction 0.23 --inclination '10 deg'", {false, false}},
        {"--throw-number 1.7 --friction 0.23 --tan-inclination -0.3", {false, false}},  // runs away
    };
    for (auto const& [options, expected] : points) {
        std::string const text =
            run_program("theory point --tan-vibration-angle 0.5 " + std::string(options)).text;
        EXPECT_NE(text.find("This is a single mass"), std::string::npos) << text;
        EXPECT_EQ(text.find("up to twice as fast") != std::string::npos, expected.first) << text;
        EXPECT_EQ(text.find("'vibrotrough predict'") != std::string::npos, expected.second) << text;
    }
}

// Possible, but hardly any machine: a warning says what is usual and which slip would explain it.
TEST(TheoryPoint, WarnsOfUnusualNumbers) {
    std::string const angle = " --vibration-angle \"25 deg\" ";
    std::pair<char const*, char const*> const slips[] = {
        {"--frequency \"960 Hz\" --amplitude \"4 mm\" --friction 0.3",
         "were 960 turns per minute meant (rpm)?"},
        {"--rpm 16 --amplitude \"4 mm\" --friction 0.3", "were 16 Hz meant, not rpm?"},
        {"--rpm 960 --stroke \"9.7 m\" --friction 0.3", "were 9.7 mm meant?"},
        {"--rpm 960 --amplitude \"9.7 mm\" --friction 0.3", "was the stroke given as the amplitude"},
        {"--throw-number 2 --friction 30", "an angle of friction meant (its tangent is 0.577)"},
    };
    for (auto const& [options, told] : slips)
        EXPECT_NE(run_program("theory point " + (options + angle)).text.find(told), std::string::npos)
            << options;
    Answer const usual = run_program("theory point --rpm 960 --stroke \"9.7 mm\" --friction 0.3" + angle);
    EXPECT_EQ(usual.text.find("warning"), std::string::npos) << usual.text;
}

// What the campaign file says of numbers, the other commands say, too; before an error, which it may explain.
TEST(TheoryPoint, AllCommandsWarnOfUnusualNumbers) {
    std::string const design = "design --mass-flow '12 t/h' --bulk-density '600 kg/m3' --width '300 mm' ";
    std::string const layer = "theory point --rpm 960 --stroke '9.7 mm' --vibration-angle '30 deg' ";
    std::pair<std::string, char const*> const slips[] = {
        {"theory limits --friction 30", "was an angle of friction meant"},
        {"theory limits --friction 0.3 --tan-vibration-angle 0.009", "were radians meant"},
        {design + "--friction 0.3 --rpm 16 --stroke '12 mm'", "were 16 Hz meant, not rpm?"},
        {design + "--friction 0.3 --frequency '960 Hz'", "were 960 turns per minute meant (rpm)?"},
        {design + "--friction 0.3 --rpm 960 --amplitude '9.7 mm'", "was the stroke given as the amplitude"},
        {design + "--friction 0.3 --vibration-angle '0.5 deg'", "were radians meant (28.6 degrees)?"},
        {"design --mass-flow '12 t/h' --bulk-density '0.6 kg/m3' --width '300 mm' --friction 0.3",
         "were 0.6 t/m3 meant (600 kg/m3)?"},
        {design + "--friction 0.3 --stroke '9.7 m'", "were 9.7 mm meant?"},
        {layer + "--friction 0.3 --bulk-density '0.6 kg/m3'", "were 0.6 t/m3 meant (600 kg/m3)?"},
        {layer + "--friction 0.3 --frequency '16 Hz'", "both given"},
    };
    for (auto const& [command, told] : slips)
        EXPECT_NE(run_program(command).text.find(told), std::string::npos) << command << "\n"
                                                                           << run_program(command).text;
    Answer const usual = run_program(design + "--friction 0.3 --rpm 960 --stroke '9.7 mm'");
    EXPECT_EQ(usual.text.find("warning"), std::string::npos) << usual.text;
}

// Errors of `design` speak of what was typed, in its unit, and name the slip.
TEST(Design, AnswersInTheUnitThatWasTyped) {
    auto const refused = [](std::string const& options, std::string const& words) {
        Answer const answer = run_program(
            "design --mass-flow '12 t/h' --bulk-density '600 kg/m3' --width '300 mm' --friction 0.3 " +
            options);
        EXPECT_EQ(answer.exit_code, 2) << options;
        EXPECT_NE(answer.text.find(words), std::string::npos) << options << "\n" << answer.text;
    };
    refused("--inclination '95 deg'", "--inclination 95 deg: must lie between -45 and 45 deg;");
    refused("--inclination '2 rad'",
            "--inclination 2 rad: must lie between -0.785398 and 0.785398 rad (were 2 deg meant?)");
    refused("--inclination '0.7 rad'", "--inclination 0.7 rad: must lie between -0.277639 and 0.277639 rad");
    refused("--inclination '20 deg to 30 deg'", "must lie between -15.9076 and 15.9076 deg");
    refused("--vibration-angle '30 rad'", "(were 30 deg meant?)");
    refused("--stroke '30 m'", "--stroke 30 m: must lie between 2e-06 and 2 m (were 30 mm meant?)");
    refused("--rpm 960 --amplitude '40 mm'", "an amplitude of 4.85 mm or less");
    refused("--frequency '960 Hz'", "a frequency of 49.8 Hz or less");
}

// Motors are speeds of the drive: n = 120 f / p (1 - slip) turns per minute. Tolerance: none, the products
// are whole numbers and the answers have four digits.
TEST(Design, ChoosesAmongMotors) {
    auto const design = [](std::string const& motors) {
        return run_program(
            "design --mass-flow '3 t/h' --bulk-density '600 kg/m3' --width '300 mm' --friction 0.3 "
            "--vibration-angle '30 deg' --machine-number 4 --objective least-machine-number "
            "--model-discrepancy 0.05 " +
            motors);
    };
    std::pair<char const*, char const*> const same[] = {
        {"--poles 4,6,8 --mains 50", "--rpm 1500,1000,750"},
        {"--poles 4,6 --mains '60 Hz' --slip '4 %'", "--rpm 1728,1152"},
        {"--poles 8 --mains 50 --slip 0.04", "--rpm 720"}};
    for (auto const& [motors, speeds] : same) {
        Answer const answer = design(motors);
        EXPECT_EQ(answer.exit_code, 0) << answer.text;
        EXPECT_EQ(answer.text, design(speeds).text) << motors;
    }
    std::pair<char const*, char const*> const refused[] = {
        {"--poles 4,6,8", "--poles 4,6,8: also needs the frequency of the mains; write --mains 50"},
        {"--mains 50", "--mains 50: belongs to the poles of a motor; write --poles 4,6,8 as well"},
        {"--slip 0.03 --rpm 960", "--slip 0.03: belongs to the poles of a motor"},
        {"--poles 4 --mains 50 --rpm 960", "--poles 4 and --rpm 960 are both given"},
        {"--poles 4 --mains 50 --frequency '16 Hz'", "--poles 4 and --frequency 16 Hz are both given"},
        {"--poles 4,5 --mains 50", "--poles 4,5: 5 must be even, because poles come in pairs; write"},
        {"--poles 960 --mains 50", "--poles 960: must be at least 2 and at most 48"},
        {"--poles '4 to 8' --mains 50", "is a range, and here one value is needed"},
        {"--poles 4,,8 --mains 50", "write for example --poles 4,6,8"},
        {"--poles '' --mains 50", "--poles is empty; write for example --poles 4,6,8"},
        {"--poles 4 --mains '50 V'", "--mains 50 V: 'V' cannot be converted to Hz"},
        {"--poles 4 --mains 0", "--mains 0 Hz: must lie between 1 and 400 Hz"},
        {"--poles 4 --mains 50 --slip 3", "--slip 3: must be at least 0 and at most 0.3"}};
    for (auto const& [motors, words] : refused) {
        Answer const answer = design(motors);
        EXPECT_EQ(answer.exit_code, 2) << motors << "\n" << answer.text;
        EXPECT_NE(answer.text.find(words), std::string::npos) << motors << "\n" << answer.text;
    }
}

// One friction is not a range, and flows have no powers of ten.
TEST(Design, WritesPlainNumbers) {
    Answer const large = run_program(
        "design --mass-flow '12000 t/h' --bulk-density '1600 kg/m3' --width '3 m' --friction 0.3");
    EXPECT_NE(large.text.find("carries 12000 t/h"), std::string::npos) << large.text;
    EXPECT_NE(large.text.find("for a friction of 0.3 (point mass"), std::string::npos) << large.text;
    EXPECT_EQ(large.text.find("e+0"), std::string::npos) << large.text;
    Answer const range = run_program(
        "design --mass-flow '12 t/h' --bulk-density '600 kg/m3' --width '300 mm' --friction '0.25 to 0.35' "
        "--model-discrepancy 0.05");
    EXPECT_NE(range.text.find("for frictions of 0.2"), std::string::npos) << range.text;
}

// A range may have its unit once, and a dash between plain numbers; a minus before one value is its sign.
TEST(Design, TakesRangesAsPeopleWriteThem) {
    auto const design = [](std::string const& limits) {
        return run_program(
            "design --mass-flow \"12 t/h\" --bulk-density \"600 kg/m3\" --width \"300 mm\" "
            "--friction 0.3 --model-discrepancy 0.05 --inclination \"-2 deg\" " +
            limits);
    };
    Answer const expected =
        design("--vibration-angle \"25 deg to 35 deg\" --rpm \"900 to 1000\" --stroke \"4 mm to 8 mm\"");
    ASSERT_EQ(expected.exit_code, 0) << expected.text;
    for (char const* const same :
         {"--vibration-angle \"25-35 deg\" --rpm 900-1000 --stroke \"4-8 mm\"",
          "--vibration-angle \"25 to 35 deg\" --rpm \"900 to 1000 rpm\" --stroke \"4 to 8 mm\""})
        EXPECT_EQ(design(same).text, expected.text) << same;
    Answer const turned = design("--vibration-angle \"35-25 deg\"");
    EXPECT_EQ(turned.exit_code, 2);
    EXPECT_NE(turned.text.find("the first value is above the second"), std::string::npos) << turned.text;
}

// tan(30 deg) and the angle itself are one input. Tolerance: rounding of the tangent.
TEST(TheoryPoint, TakesAnglesWithUnits) {
    auto const angle =
        point("--throw-number 1.5 --vibration-angle '30 deg' --inclination '-3 deg' --friction 0.3");
    auto const tangent = point(
        "--throw-number 1.5 --tan-vibration-angle 0.57735026918962576 --tan-inclination "
        "-0.052407779283041195 "
        "--friction 0.3");
    EXPECT_NEAR(angle.at("velocity_efficiency"), tangent.at("velocity_efficiency"), 1e-12);
}

TEST(TheoryPoint, SaysWhenTheMassRunsAway) {
    std::string const options =
        "theory point --throw-number 2 --tan-vibration-angle 0.5 --tan-inclination 0.3 --friction 0.23";
    Answer const shown = run_program(options + " --json");
    EXPECT_EQ(shown.exit_code, 1) << "a script notices that there is no speed";
    auto const answer = nlohmann::json::parse(shown.text);
    EXPECT_EQ(answer.at("converged"), false);
    EXPECT_TRUE(answer.at("velocity_efficiency").is_null());
    EXPECT_NE(answer.at("outcome").get<std::string>().find("runs away"), std::string::npos);
    std::string const text = run_program(options).text;
    EXPECT_NE(text.find("velocity efficiency  none"), std::string::npos) << text;
    EXPECT_EQ(text.find("inf"), std::string::npos) << text;
}

TEST(TheoryPoint, RefusesWrongInputInOneLine) {
    auto const refused = [](std::string const& options, std::string const& words) {
        Answer const answer = run_program("theory point " + options);
        EXPECT_EQ(answer.exit_code, 2) << options;
        EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
        EXPECT_NE(answer.text.find(words), std::string::npos) << answer.text;
    };
    refused("--throw-number two --tan-vibration-angle 0.5 --friction 0.3", "--throw-number two: ");
    refused("--throw-number -2 --tan-vibration-angle 0.5 --friction 0.3", "must be at least");
    refused("--throw-number nan --tan-vibration-angle 0.5 --friction 0.3", "finite");
    refused("--tan-vibration-angle 0.5 --friction 0.3", "--throw-number is missing");
    refused("--throw-number 2 --friction 0.3", "--vibration-angle is missing");
    refused("--throw-number 2 --vibration-angle 30 --friction 0.3", "'30' has no unit");
    refused("--throw-number 2 --vibration-angle '30 mm' --friction 0.3", "cannot be converted");
    refused("--throw-number 2 --vibration-angle '95 deg' --friction 0.3", "between 0 and 89 deg;");
    refused("--throw-number 2 --vibration-angle '30 deg' --tan-vibration-angle 1 --friction 0.3", "only one");
    refused("--throw-number 2 --vibration-angle '30 deg' --friction -0.1", "--friction -0.1");
}

TEST(TheoryPoint, TeachesWithAnExample) {
    Answer const answer = run_program("theory point --help");
    EXPECT_EQ(answer.exit_code, 0);
    EXPECT_NE(answer.text.find("Example:\n  vibrotrough theory point"), std::string::npos);
}

// Eq. 22 with a = 0 is the sinusoidal case; noise of 0.2 at order 25 moves eta by less than 10 % (the paper's
// finding).
TEST(TheoryPoint, TakesHarmonicsAndWhatIsBeyond) {
    std::string const base = "--throw-number 1.5 --tan-vibration-angle 0.5 --friction 0.3 ";
    double const plain = point(base).at("velocity_efficiency");
    EXPECT_NEAR(point(base + "--harmonic-normal '25,0,0 deg'").at("velocity_efficiency"), plain, 1e-9);
    double const noisy = point(base + "--harmonic-along '25,0.2,0 deg' --harmonic-normal '25,0.2,0 deg'")
                             .at("velocity_efficiency");
    EXPECT_NE(noisy, plain);
    EXPECT_NEAR(noisy, plain, 0.1 * plain);
    EXPECT_NEAR(point(base + "--static-friction 0.3").at("velocity_efficiency"), plain, 1e-9);
    EXPECT_NEAR(point(base + "--along-ratio 1 --along-phase '0 deg'").at("velocity_efficiency"), plain, 1e-9);
    // Side walls add k mu_w H / W = 0.1 to mu.
    double const walls =
        point(base + "--wall-friction 0.4 --height-over-width 0.5").at("velocity_efficiency");
    double const stronger =
        point("--throw-number 1.5 --tan-vibration-angle 0.5 --friction 0.4").at("velocity_efficiency");
    EXPECT_NEAR(walls, stronger, 1e-9);
    auto const expect_refused = [](std::string const& options, std::string const& words) {
        Answer const answer = run_program("theory point " + options);
        EXPECT_EQ(answer.exit_code, 2) << answer.text;
        EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
        EXPECT_NE(answer.text.find(words), std::string::npos) << answer.text;
    };
    expect_refused(base + "--restitution 1.2", "--restitution 1.2");
    expect_refused(base + "--harmonic-along 3", "order, amplitude and phase");
    expect_refused(base + "--static-friction 0.1", "below --friction");
}

// Table 1 at Gamma = 2, tan(alpha) = 0, e = 0.2: the physics gives 0.495, the named rule the printed 0.838.
// Tolerance: the table's third decimal, and the 0.002 of the issue.
TEST(TheoryPoint, TakesTheRuleOfTable1ByName) {
    std::string const base = "--throw-number 2 --tan-vibration-angle 0.25 --friction 0.23 --restitution 0.2 ";
    EXPECT_NEAR(point(base).at("velocity_efficiency"), 0.4952, 0.001);
    EXPECT_NEAR(point(base + "--table-1-rule").at("velocity_efficiency"), 0.838, 0.002);
}

}  // namespace
}  // namespace vibrotrough
