#include "scenario/reader/campaign_file.hpp"

#include "core/error.hpp"
#include "example_campaign.hpp"
#include "scenario/reader/keys.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"

#include <cmath>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

std::string sweep(std::string const& lines) {
    return example_campaign + "[sweep]\n" + lines;
}

TEST(CampaignFile, MultipliesTheSweep) {
    scenario::Campaign const campaign =
        scenario::parse_campaign(sweep(R"("trough.throw_number" = { from = 0.6, to = 3.0, step = 0.4 }
"trough.tan_vibration_angle" = [0.25, 0.5, 1.0]
)"),
                                 "c.toml");
    ASSERT_EQ(campaign.cases.size(), 21u);
    // A swept tan(beta) replaces the angle given above it; the last key runs fastest.
    EXPECT_DOUBLE_EQ(std::tan(campaign.cases[0].trough.vibration_angle), 0.25);
    EXPECT_DOUBLE_EQ(std::tan(campaign.cases[1].trough.vibration_angle), 0.5);
    EXPECT_NEAR(throw_number(campaign.cases[20].trough), 3.0, 1e-12);
    EXPECT_NEAR(throw_number(campaign.cases[3].trough), 1.0, 1e-12);
}

TEST(CampaignFile, SweepsQuantitiesAndWholeNumbers) {
    EXPECT_DOUBLE_EQ(scenario::parse_campaign(sweep(R"("layer.height" = ["12 mm", "18 mm"])"), "c")
                         .cases[1]
                         .layer.height.value(),
                     0.018);
    EXPECT_EQ(scenario::parse_campaign(sweep(R"("layer.grains" = [100, 200])"), "c").cases[1].layer.grains,
              200);
    EXPECT_EQ(scenario::parse_campaign(sweep("trough.friction = [0.1, 0.2]"), "c").cases[1].trough.friction,
              0.2);
    auto const angles = scenario::parse_campaign(
        sweep(R"("trough.vibration_angle" = { from = "20 deg", to = "40 deg", step = "10 deg" })"), "c");
    ASSERT_EQ(angles.cases.size(), 3u);
    EXPECT_NEAR(angles.cases[1].trough.vibration_angle, std::acos(-1.0) / 6,
                1e-11);  // ranges are kept to 12 digits
    // A key that only the sweep gives is given.
    EXPECT_EQ(
        scenario::parse_campaign(with("friction = 0.23\n", "") + "[sweep]\n\"trough.friction\" = [0.1]", "c")
            .cases.size(),
        1u);
}

// r = stroke / 2, f = turns per minute / 60, density = bulk density / 0.58. The case is the same, however it
// is written. Tolerance: rounding of the divisions.
TEST(CampaignFile, TakesAnEngineersUnits) {
    auto const plain =
        scenario::parse_campaign(with("throw_number = 2.0", "frequency = \"13 Hz\""), "c").cases;
    std::string text = with("throw_number = 2.0", "frequency = \"780 rpm\"");
    text = with("amplitude = \"6 mm\"", "stroke = \"12 mm\"", text);
    text = with("density = \"1400 kg/m3\"", "bulk_density = \"812 kg/m3\"", text);
    auto const written = scenario::parse_campaign(text, "c").cases;
    EXPECT_EQ(written[0].trough.amplitude, plain[0].trough.amplitude);
    EXPECT_NEAR(written[0].trough.frequency, plain[0].trough.frequency, 1e-13);
    EXPECT_NEAR(written[0].grains.density, plain[0].grains.density, 1e-10);
    EXPECT_NEAR(bulk_density(plain[0].grains), 812, 1e-10);
    auto const strokes =
        scenario::parse_campaign(sweep("\"trough.stroke\" = [\"8 mm\", \"12 mm\"]\n[[exclude]]\n"
                                       "\"trough.amplitude\" = { above = \"5 mm\" }\n"),
                                 "c")
            .cases;
    ASSERT_EQ(strokes.size(), 1u);
    EXPECT_EQ(strokes[0].trough.amplitude, 0.004);
    EXPECT_EQ(
        error_of(with("amplitude = \"6 mm\"", "amplitude = \"6 mm\"\nstroke = \"12 mm\"")),
        "c.toml:8:1: trough.stroke: trough.amplitude is also given, on line 7, and both set the amplitude; "
        "keep one of the two");
    EXPECT_NE(error_of(with("density = \"1400 kg/m3\"", "density = \"1.4 tons/m3\"")).find("metric tonnes"),
              std::string::npos);
}

TEST(CampaignFile, ZeroHasNoSign) {
    // Found by the fuzz target `campaign`: the case's own campaign file said "-0", which was read as another
    // text.
    std::string const negative = with("diameter_spread = 0.1", "diameter_spread = -0.0");
    std::string const frozen = to_toml(scenario::parse_campaign(negative, "c").cases.front());
    EXPECT_EQ(frozen, to_toml(scenario::parse_campaign(frozen, "c").cases.front()));
    EXPECT_EQ(frozen.find("-0\n"), std::string::npos) << frozen;
}

TEST(CampaignFile, HasDefaultsForTheMeasurementOnly) {
    std::string const text = example_campaign.substr(0, example_campaign.find("[measure]"));
    scenario::Scenario const s = scenario::parse_campaign(text, "c").cases.front();
    EXPECT_EQ(s.measure.packings, 3);
    EXPECT_EQ(s.measure.max_cycles, 200);
    EXPECT_EQ(s.output.frames_per_cycle, 0);
}

TEST(CampaignFile, ErrorsNamePositionProblemAndCure) {
    EXPECT_THAT(error_of(with("amplitude = \"6 mm\"", "amplitude = 6")),
                testing::StartsWith("c.toml:7:13: trough.amplitude: the number 6 has no unit"));
    EXPECT_THAT(error_of(with("amplitude = \"6 mm\"", "amplitude = \"6 s\"")),
                testing::StartsWith("c.toml:7:13: trough.amplitude: 's' cannot be converted to m"));
    EXPECT_THAT(error_of(with("amplitude", "amplitud")),
                testing::StartsWith("c.toml:7:1: trough.amplitud: unknown key"));
    EXPECT_THAT(error_of(with("amplitude = \"6 mm\"\n", "")),
                testing::StartsWith(
                    "c.toml:4:2: trough.amplitude: is missing (exactly one of amplitude, stroke is needed)"));
    EXPECT_THAT(error_of(with("throw_number = 2.0\n", "")),
                testing::StartsWith("c.toml:4:2: trough.throw_number: is missing (exactly one of "
                                    "throw_number, machine_number, frequency is needed)"));
    EXPECT_EQ(
        error_of(with("friction = 0.23", "friction = -0.23")),
        "c.toml:9:12: trough.friction: -0.23 is out of range; write friction = 0.23, in the range 0 to 5");
    EXPECT_THAT(error_of(with("friction = 0.23", "friction = \"0.23\"")),
                testing::StartsWith(
                    "c.toml:9:12: trough.friction: '0.23' is a text, but the key needs a plain number"));
    EXPECT_EQ(
        error_of(with("friction = 0.23", "friction = nan")),
        "c.toml:9:12: trough.friction: nan is out of range; write friction = 0.23, in the range 0 to 5");
    EXPECT_THAT(error_of(with("packings = 3", "packings = 3.5")),
                testing::StartsWith("c.toml:28:12: measure.packings: 3.5 is not a whole number"));
    EXPECT_THAT(error_of(with("throw_number = 2.0", "throw_number = 2.0\nfrequency = \"10 Hz\"")),
                testing::StartsWith("c.toml:9:1: trough.frequency: trough.throw_number is also given, on "
                                    "line 8, and both set the speed of the drive"));
    EXPECT_THAT(
        error_of(with("length = \"36 mm\"", "length = \"12 mm\"")),
        testing::StartsWith("c.toml:23:1: layer.length: 12 mm is less than 4 diameters of the largest grains "
                            "(3.3 mm each); write at least \"13.2 mm\""));
}

TEST(CampaignFile, SweepsWords) {
    auto const cases =
        scenario::parse_campaign(sweep("grains.rotation = [\"free\", \"rolling\", \"blocked\"]\n"
                                       "grains.rolling_friction = [0.1]\n"),
                                 "c")
            .cases;
    ASSERT_EQ(cases.size(), 3u);
    EXPECT_EQ(cases[1].grains.rotation, scenario::Rotation::rolling);
    EXPECT_EQ(cases[1].grains.rolling_friction, 0.1);
    EXPECT_EQ(cases[2].grains.rotation, scenario::Rotation::blocked);
    EXPECT_EQ(cases[2].grains.rolling_friction, 0);  // what has no effect is not another case
}

TEST(CampaignFile, EveryErrorIsOneLine) {
    std::string const strange = std::string("\"ab'$(x)") + std::string(300, 'y') + "\" = 1\n";
    for (std::string const& text :
         {std::string(),
          std::string("["),
          std::string("x = 1"),
          std::string("[trough"),
          with("[layer]", "[lair]"),
          with("name = \"pvc-horizontal\"", "name = \"../x\""),
          with("name = \"pvc-horizontal\"", "name = 1"),
          with("[trough]", "[trough]\n" + strange),
          with("throw_number = 2.0", "throw_number = 1e999"),
          with("throw_number = 2.0", "throw_number = [1]"),
          with("vibration_angle = \"30 deg\"", "vibration_angle = \"0 deg\""),
          with("height = \"12 mm\"", "height = \"1 mm\""),
          with("height = \"12 mm\"", "diameters = 0.5"),
          with("height = \"12 mm\"", "height = \"12 mm\"\ndiameters = 4"),
          with("height = \"12 mm\"", "grains = 150", with("diameter = \"3 mm\"", "diameter = \"3 um\"")),
          with("amplitude = \"6 mm\"", "amplitude = \"6 mm; shell\""),
          sweep("\"trough.friction\" = []"),
          sweep("\"trough.friction\" = [0.1, 0.1]"),
          sweep("\"trough.friction\" = 3"),
          sweep("\"trough.friction\" = {from = 1, to = 0, step = 1}"),
          sweep("\"trough.friction\" = {from = 0, to = 1}"),
          sweep("\"trough.friction\" = {from = 0, to = 1, step = 0}"),
          sweep("\"trough.friction\" = {from = 0, to = 1, step = inf}"),
          sweep("\"trough.friction\" = {from = nan, to = 1, step = 1}"),
          sweep("\"trough.friction\" = {from = 0, to = inf, step = inf}"),
          sweep("\"trough.friction\" = {from = 0, to = 9, step = 1}"),
          sweep("\"trough.friction\" = {from = 0, to = 1, stop = 1}"),
          sweep("\"campaign.name\" = [1]"),
          sweep("\"trough.friction\" = [0.1]\ntrough.friction = [0.2]"),
          with("throw_number = 2.0", "frequency = \"100 Hz\""),
          with("rolling_friction = 0.0", "rolling_friction = 0.1"),
          with("rolling_friction = 0.0", "rotation = \"rolling\""),
          with("rolling_friction = 0.0", "rotation = \"blokked\""),
          with("rolling_friction = 0.0", "rotation = 1"),
          with("rolling_friction = 0.0", "size_law = \"gauss\""),
          with("rolling_friction = 0.0", "number_fractions = [1]"),
          with("rolling_friction = 0.0", "shape = \"cube\""),  // in three sizes
          with("diameter_spread = 0.1", "shape = \"ball\""),
          with("diameter_spread = 0.1", "shape = \"../secret.csv\""),
          with("diameter_spread = 0.1", "shape = \"no-such-file.csv\""),
          with("diameter = \"3 mm\"", "diameters = []"),
          with("diameter = \"3 mm\"", "diameters = [\"3 mm\"]"),
          with("diameter = \"3 mm\"\ndiameter_spread = 0.1", "diameters = [\"3 mm\"]"),
          with("diameter = \"3 mm\"\ndiameter_spread = 0.1",
               "diameters = [\"3 mm\"]\nmass_fractions = [1, 2]"),
          with("throw_number = 2.0", "throw_number = 2.0\nharmonics = [\"25\"]"),
          with("throw_number = 2.0", "throw_number = 2.0\nharmonics = [\"1, 0.2, 0 deg\"]"),
          with("throw_number = 2.0", "throw_number = 2.0\nharmonics = [\"2, x, 0 deg\"]"),
          with("throw_number = 2.0", "throw_number = 2.0\nharmonics = [\"2, 0.2, 3 mm\"]"),
          with("throw_number = 2.0", "throw_number = 2.0\nharmonics = 25"),
          with("throw_number = 2.0", "throw_number = 2.0\nwaveform = \"none.csv\""),
          with("height = \"12 mm\"", "block = \"point\""),  // in three sizes
          with("height = \"12 mm\"", "block = \"ball\""),
          sweep("\"grains.rotation\" = [\"free\", \"free\"]"),
          sweep("\"trough.harmonics\" = [[\"2, 0.2, 0 deg\"]]"),
          sweep("\"no.key\" = [1]"),
          sweep("throw_number = [1]"),
          sweep("\"layer.height\" = [\"12 mm\"]\n\"layer.grains\" = [3]"),
          std::string("campaign = 1\n")}) {
        try {
            scenario::parse_campaign(text, "c.toml");
            ADD_FAILURE() << "accepted: " << text;
        } catch (core::InputError const& error) {
            for (std::string const& problem : error.problems()) {
                EXPECT_EQ(problem.find("c.toml:"), 0u) << problem << "\n in: " << text;
                EXPECT_EQ(problem.find_first_of("\n\r"), std::string::npos) << problem;
                EXPECT_LT(problem.size(), 400u) << problem;
            }
        }
    }
}

// All mistakes of a file are told in one call; a key that is refused, or the one that was meant, is not
// missing, too.
TEST(CampaignFile, SeveralMistakesAreToldAtOnce) {
    std::string text = with("throw_number = 2.0", "throw_nummer = 2.0");
    text = std::regex_replace(text, std::regex("height = \"12 mm\""), "height = \"12,5 mm\"");
    text += "[engin]\ncontact = \"hooke\"\n";
    try {
        scenario::parse_campaign(text, "c.toml");
        FAIL() << "accepted";
    } catch (core::InputError const& error) {
        ASSERT_EQ(error.problems().size(), 3u) << error.what();
        EXPECT_NE(
            error.problems()[0].find("trough.throw_nummer: unknown key; did you mean trough.throw_number?"),
            std::string::npos)
            << error.what();
        EXPECT_NE(error.problems()[1].find("'12,5 mm' has a decimal comma; write 12.5 mm"), std::string::npos)
            << error.what();
        EXPECT_NE(error.problems()[2].find("engin: unknown section; did you mean [engine]?"),
                  std::string::npos)
            << error.what();
    }
}

// A percentage is a number, as on the command line; other texts are not.
TEST(CampaignFile, PercentagesAreNumbers) {
    std::string const plain = with("throw_number = 2.0", "throw_number = 2.0");
    auto const with_friction = [&](char const* value) {
        return std::regex_replace(plain, std::regex("friction = 0.23"), std::string("friction = ") + value);
    };
    auto const campaign = scenario::parse_campaign(with_friction("\"30 %\""), "c.toml");
    EXPECT_EQ(campaign.cases.at(0).trough.friction, 0.3);
    EXPECT_NE(error_of(with_friction("\"0.3\"")).find("write friction = 0.3 without quotes"),
              std::string::npos);
    EXPECT_NE(error_of(with_friction("\"0,3\"")).find("'0,3' has a decimal comma; write 0.3"),
              std::string::npos);
    EXPECT_NE(error_of(with_friction("\"smooth\"")).find("needs a plain number"), std::string::npos);
}

TEST(CampaignFile, AMistypedPathIsWrongInput) {
    EXPECT_THROW(scenario::read_campaign("no-such-file.toml"), core::InputError);
    EXPECT_THROW(scenario::read_campaign("/"), core::InputError);
}

}  // namespace
}  // namespace vibrotrough
