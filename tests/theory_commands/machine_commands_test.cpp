#include "run_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// A machine that exists, and one that is to be ordered: what the commands say without a simulation.
namespace vibrotrough {
namespace {

using testing::HasSubstr;

std::string const given_machine = "--rpm 1000 --stroke '8 mm' --vibration-angle '25 deg' ";
std::string const plant =
    "design --mass-flow '12 t/h' --width '400 mm' --length '3 m' --rpm 960 --stroke '8 mm' "
    "--vibration-angle '30 deg' --layer-depth '20 to 60 mm' ";

nlohmann::json answer_of(std::string const& arguments, int exit_code = 0) {
    Answer const answer = run_program(arguments + " --json", StandardError::dropped);
    EXPECT_EQ(answer.exit_code, exit_code) << arguments;
    return nlohmann::json::parse(answer.text);
}

// The machine of issue U: the point mass has 0.187 m/s, and the atlas 0.312 of spheres of 3 mm
// that roll freely. Who does not know the grains gets an interval that holds it.
TEST(Machine, IsPredictedAsALayerAndNotAsAPointMass) {
    std::string const spheres = "--grain-diameter '3 mm' --layer-depth '12 mm' --rolling-friction 0";
    auto const found = answer_of("predict " + given_machine + "--friction 0.3");
    EXPECT_NEAR(found.at("point_mass_speed_m_per_s"), 0.187, 5e-4);
    double const speed =
        answer_of("predict " + given_machine + "--friction 0.3 " + spheres).at("speed_m_per_s");
    EXPECT_NEAR(speed, 0.312, 5e-4);
    EXPECT_NEAR(found.at("speed_m_per_s").get<double>(), speed,
                found.at("speed_half_width_m_per_s").get<double>());
    EXPECT_TRUE(found.at("mass_flow_t_per_h").is_null());
    Answer const text = run_program("predict " + given_machine + "--friction 0.3");
    for (char const* const told : {"Grains that roll", "write --width", "the depth of the layer", "mode "})
        EXPECT_THAT(text.text, HasSubstr(told));
    EXPECT_THAT(run_program("theory point " + given_machine + "--friction 0.3").text,
                HasSubstr("'vibrotrough predict'"));
}

// m = rho w h v; an input that is less exact has a wider interval.
TEST(Machine, HasAMassFlow) {
    std::string const layer =
        given_machine +
        "--width '400 mm' --layer-depth '40 mm' --bulk-density '600 kg/m3' --grain-diameter '4 mm' ";
    auto const exact = answer_of("predict " + layer + "--friction 0.3");
    EXPECT_NEAR(exact.at("mass_flow_t_per_h"),
                3.6 * 600 * 0.4 * 0.04 * exact.at("speed_m_per_s").get<double>(), 1e-9);
    auto const inexact = answer_of("predict " + layer + "--friction 0.3+-0.05");
    EXPECT_GT(inexact.at("half_width"), exact.at("half_width"));
}

TEST(Machine, AsksForWhatIsMissing) {
    EXPECT_EQ(run_program("predict").exit_code, 2);
    EXPECT_THAT(run_program("predict --rpm 1000 --friction 0.3").text, HasSubstr("--stroke"));
    EXPECT_THAT(run_program("predict campaign.toml " + given_machine).text,
                HasSubstr("either a campaign or a machine"));
}

// What no model knows is refused with its reason, or answered without a probability.
TEST(Machine, GrainsThatNoModelKnowsHaveAReason) {
    std::pair<std::string, char const*> const refused[] = {
        {"--friction 0.4 --bulk-density '800 kg/m3' --grain-diameter '0.05 mm'", "air between grains"},
        {"--material cement", "air between grains"},
        {"--material sugar --grain-kind moist", "stick to each other"},
        {"--material 'wood chips'", "flakes"}};
    for (auto const& [words, reason] : refused) {
        Answer const design = run_program(plant + words);
        EXPECT_EQ(design.exit_code, 2) << words;
        EXPECT_THAT(design.text, HasSubstr(reason));
        EXPECT_THAT(run_program("predict " + given_machine + words).text, HasSubstr(reason));
    }
    for (std::string const words :
         {"--material 'wood pellets'", "--material gravel --grain-diameter '0 to 30 mm'"}) {
        auto const found = answer_of(plant + words, 1);
        EXPECT_TRUE(found.at("probability").is_null()) << words;
        EXPECT_THAT(found.at("sentence").get<std::string>(), HasSubstr("Not tested"));
    }
    EXPECT_THAT(
        run_program("predict " + given_machine + "--material gravel --grain-diameter '0 to 30 mm'").text,
        HasSubstr("Alone, such a layer"));
    EXPECT_THAT(run_program("predict " + given_machine + "--material wheet").text,
                HasSubstr("was wheat meant?"));
}

TEST(Machine, IsDescribedByTheNameOfItsMaterial) {
    auto const found = answer_of("predict " + given_machine + "--material 'plastic pellets'");
    EXPECT_GT(found.at("speed_m_per_s"), 0.2);
    auto const own = answer_of("predict " + given_machine + "--material 'plastic pellets' --friction 0.3");
    EXPECT_LT(own.at("half_width"), found.at("half_width"));
}

// Two motors of 8 kN are one exciter of 16 kN; F = m_u r omega^2.
TEST(Machine, HasMotorsAndSprings) {
    std::string const words =
        plant + "--material 'plastic pellets' --trough-mass '250 kg' --spring '150 N/mm' ";
    auto const exciter = answer_of(words).at("exciter");
    EXPECT_NEAR(exciter.at("springs").at("sag_mm"),
                1e3 * (250 + exciter.at("material_kg").get<double>()) * 9.81 / 150e3, 1e-6);
    EXPECT_NEAR(exciter.at("springs").at("force_on_building_n"), 150e3 * 0.004, 1e-6);
    double const moment = exciter.at("motors").at("static_moment_kg_m");
    EXPECT_NEAR(2 * moment * exciter.at("motors").at("setting").get<double>(),
                exciter.at("static_moment_kg_m"), 1e-9);
    EXPECT_THAT(run_program(words).text, testing::ContainsRegex("motors +2 x [0-9]+ kN at [0-9]+ %"));
    Answer const soft = run_program(plant + "--material maize --trough-mass '250 kg' --spring '9.4 N/mm'");
    EXPECT_EQ(soft.exit_code, 2);
    EXPECT_THAT(soft.text, HasSubstr("sags by 261 mm"));
    std::string const driven =
        "design --mass-flow '6 t/h' --width '400 mm' --length '3 m' --rpm 960 --vibration-angle '30 deg' "
        "--material "
        "maize --trough-mass '250 kg' --exciter ";
    EXPECT_EQ(answer_of(driven + "'2 x 6 kN at 960 rpm'").at("exciter"),
              answer_of(driven + "'12 kN at 960 rpm'").at("exciter"));
}

// A kind of drive has limits of its own, which what is asked for replaces.
TEST(Machine, KeepsToItsKindOfDrive) {
    std::string const words =
        "design --mass-flow '12 t/h' --width '400 mm' --material maize --drive 'unbalance motors'";
    auto const found = answer_of(words);
    EXPECT_LE(found.at("stroke_mm"), 16 + 1e-9);
    EXPECT_GE(found.at("rpm"), 700 - 1e-9);
    std::string const magnet =
        "design --mass-flow '6 t/h' --width '400 mm' --material maize --drive magnet --rpm ";
    EXPECT_THAT(run_program(magnet + "2100").text, HasSubstr("magnet, with a controller for 35 Hz"));
    EXPECT_THAT(run_program(magnet + "3000").text, HasSubstr("kind of drive     magnet\n"));
}

// A surge makes the design's mass flow larger, and its layer in operation thinner.
TEST(Machine, IsMadeForASurge) {
    std::string const words = "design --mass-flow '14 t/h' --width '400 mm' --material maize --rpm 960";
    auto const usual = answer_of(words), surge = answer_of(words + " --surge 1.3");
    EXPECT_NEAR(surge.at("mass_flow_wanted_t_per_h"), 1.3 * 14, 1e-9);
    EXPECT_GT(surge.at("layer_depth_mm"), usual.at("layer_depth_mm"));
    EXPECT_LT(surge.at("depth_in_operation_mm"), surge.at("layer_depth_mm"));
    EXPECT_GE(surge.at("side_wall_mm").get<double>(), surge.at("layer_depth_mm").get<double>() + 50);
}

}  // namespace
}  // namespace vibrotrough
