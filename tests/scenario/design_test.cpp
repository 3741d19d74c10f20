#include "scenario/reader/design.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/sample_cube.hpp"
#include "single_case.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

std::vector<double> throw_numbers(scenario::Campaign const& campaign) {
    std::vector<double> numbers;
    for (scenario::Scenario const& scenario : campaign.cases)
        numbers.push_back(throw_number(scenario.trough));
    return numbers;
}

scenario::Campaign parse(std::string const& design) {
    return scenario::parse_campaign(example_campaign + design, "campaign.toml");
}

std::string refusal(std::string const& design) {
    return error_of(example_campaign + design);
}

TEST(Design, PointsAreCases) {
    auto const campaign = parse(
        "[[points]]\n\"trough.throw_number\" = 1.5\n\"layer.height\" = \"9 mm\"\n"
        "[[points]]\n\"trough.throw_number\" = 2.5\n\"layer.height\" = \"15 mm\"\n");
    ASSERT_EQ(campaign.cases.size(), 2u);
    EXPECT_NEAR(throw_number(campaign.cases[0].trough), 1.5, 1e-12);
    EXPECT_NEAR(throw_number(campaign.cases[1].trough), 2.5, 1e-12);
    EXPECT_DOUBLE_EQ(campaign.cases[0].layer.height.value(), 0.009);
    EXPECT_DOUBLE_EQ(campaign.cases[1].layer.height.value(), 0.015);
}

TEST(Design, ZippedListsGoInStepAndMultiplyWithTheSweep) {
    auto const campaign = parse(
        "[zip]\n\"trough.friction\" = [0.1, 0.2, 0.3]\n\"grains.friction\" = [0.4, 0.5, 0.6]\n"
        "[sweep]\n\"trough.throw_number\" = [1, 2]\n");
    ASSERT_EQ(campaign.cases.size(), 6u);
    for (scenario::Scenario const& scenario : campaign.cases)
        EXPECT_NEAR(scenario.grains.friction - scenario.trough.friction, 0.3, 1e-12);
    EXPECT_NEAR(throw_number(campaign.cases[2].trough), 1, 1e-12);
    EXPECT_NEAR(throw_number(campaign.cases[3].trough), 2, 1e-12) << "the list runs fastest";
}

TEST(Design, PointsFromACsvFile) {
    core::TemporaryFolder const own_folder;
    std::filesystem::path const& folder = own_folder.path();
    std::ofstream(folder / "points.csv")
        << "# measured\r\ntrough.throw_number, layer.height\r\n1.5,9 mm\r\n\n2.5,0.015 m\n";
    std::ofstream(folder / "campaign.toml") << example_campaign << "[points_from]\nfile = \"points.csv\"\n";
    auto const campaign = scenario::read_campaign(folder / "campaign.toml");
    ASSERT_EQ(campaign.cases.size(), 2u);
    EXPECT_DOUBLE_EQ(campaign.cases[0].layer.height.value(), 0.009);
    EXPECT_DOUBLE_EQ(campaign.cases[1].layer.height.value(), 0.015);
    EXPECT_EQ(campaign.files, std::vector{folder / "points.csv"});
    std::ofstream(folder / "points.csv") << "trough.throw_number\n1.5\nfast\n";
    try {
        scenario::read_campaign(folder / "campaign.toml");
        ADD_FAILURE() << "a word was taken for a number";
    } catch (core::InputError const& error) {
        EXPECT_TRUE(std::string(error.what())
                        .starts_with((folder / "points.csv").string() + ":3: trough.throw_number: "))
            << error.what();
    }
}

// What spreadsheets write: quotes around everything, a byte order mark, ; with decimal commas.
TEST(Design, PointsFromASpreadsheet) {
    core::TemporaryFolder const own_folder;
    std::filesystem::path const& folder = own_folder.path();
    std::ofstream(folder / "campaign.toml") << example_campaign << "[points_from]\nfile = \"points.csv\"\n";
    auto const heights = [&](std::string const& table) {
        std::ofstream(folder / "points.csv") << table;
        std::vector<double> found;
        for (auto const& scenario : scenario::read_campaign(folder / "campaign.toml").cases)
            found.push_back(std::round(1e9 * scenario.layer.height.value()));
        return found;
    };
    auto const refusal = [&](std::string const& table) -> std::string {
        try {
            heights(table);
        } catch (core::InputError const& error) {
            return error.what();
        }
        return "no error";
    };
    std::vector<double> const expected{9'000'000, 15'500'000};  // nm
    EXPECT_EQ(heights("\xEF\xBB\xBF\"layer.height\",\"trough.throw_number\"\r\n\"9 mm\",\"2\"\r\n"
                      "\"15.5 mm\",\"2.5\"\r\n"),
              expected);
    EXPECT_EQ(heights("layer.height;trough.throw_number\n9 mm;2\n15,5 mm;2,5\n"), expected);
    // A comma within quotes does not separate cells: the whole value is refused with its line.
    std::string const quoted = refusal("layer.height,trough.throw_number\n9 mm,2\n\"15,5 mm\",2.5\n");
    EXPECT_NE(quoted.find("points.csv:3: layer.height: "), std::string::npos) << quoted;
    EXPECT_NE(quoted.find("'15,5 mm' has a decimal comma; write 15.5 mm"), std::string::npos) << quoted;
    std::string const ragged = refusal("layer.height,trough.throw_number\n9 mm\n");
    EXPECT_NE(ragged.find("points.csv:2: expected 2 values, one per column, but found 1"), std::string::npos)
        << ragged;
    std::string const open = refusal("layer.height,trough.throw_number\n\"9 mm,2\n");
    EXPECT_NE(open.find("points.csv:2: an opening quote has no closing quote"), std::string::npos) << open;
    EXPECT_NE(refusal("").find("points.csv:1: the file is empty"), std::string::npos);
    EXPECT_NE(refusal("layer.elevation\n9 mm\n").find("points.csv:1:1: layer.elevation: is not a key"),
              std::string::npos);
}

TEST(Design, ExclusionsSeeGivenAndDerivedValues) {
    // K = Gamma cos(alpha) / sin(beta): 30 degrees make K = 2 Gamma.
    auto const campaign = parse(
        "[sweep]\n\"trough.throw_number\" = [1, 2, 3]\n\"layer.height\" = [\"9 mm\", \"15 mm\"]\n"
        "[[exclude]]\n\"trough.machine_number\" = { above = 5.9 }\n\"layer.height\" = { below = \"10 mm\" }\n"
        "[[exclude]]\n\"trough.throw_number\" = 2\n");
    EXPECT_EQ(campaign.excluded, 3u);
    ASSERT_EQ(campaign.cases.size(), 3u);
    auto const numbers = throw_numbers(campaign);
    EXPECT_NEAR(numbers[0], 1, 1e-12);
    EXPECT_NEAR(numbers[1], 1, 1e-12);
    EXPECT_NEAR(numbers[2], 3, 1e-12);
    EXPECT_DOUBLE_EQ(campaign.cases[2].layer.height.value(), 0.015);
}

// Many cases are made on all cores: they keep their order, and the mistake
// that is reported is that of the first wrong case.
TEST(Design, ManyCasesKeepTheirOrder) {
    std::string heights;
    for (int i = 0; i < 300; ++i) heights += fmt::format("{}\"{} um\"", i == 0 ? "" : ", ", 9000 + 10 * i);
    std::string const many =
        "[sweep]\n\"layer.height\" = [" + heights + "]\n\"trough.throw_number\" = [1, 2, 3, 4]\n";
    auto const campaign = parse(many + "[[exclude]]\n\"trough.throw_number\" = 3\n");
    EXPECT_EQ(campaign.excluded, 300u);
    ASSERT_EQ(campaign.cases.size(), 900u);
    for (int i = 0; i < 900; ++i) {
        scenario::Scenario const& one = campaign.cases[static_cast<std::size_t>(i)];
        EXPECT_DOUBLE_EQ(one.layer.height.value(), 1e-6 * (9000 + 10 * (i / 3)));
    }
    // The file is missing for all of them: the position is that of the key, whichever core met it first.
    try {
        parse("[sweep]\n\"layer.height\" = [" + heights +
              "]\n\"grains.shape\" = [\"none.csv\", \"no.csv\"]\n");
        FAIL() << "two files are missing";
    } catch (core::InputError const& error) {
        EXPECT_NE(std::string(error.what()).find("there is no file none.csv"), std::string::npos)
            << error.what();
    }
}

// Both methods put exactly one point into each of n slices of every dimension: Latin hypercubes by
// construction, Sobol's first 2^m points (with the origin; boost leaves it out, and the shift moves all)
// nearly so. Their means are therefore within 1/n of 1/2 where independent points scatter by 1/sqrt(12 n).
TEST(Design, LatinHypercubesFillEverySlice) {
    for (unsigned const seed : {1u, 2u, 77u}) {
        auto const points = scenario::sample_cube(scenario::SampleMethod::latin_hypercube, 50, 4, seed);
        for (std::size_t k = 0; k < 4; ++k) {
            std::set<int> slices;
            for (auto const& point : points) slices.insert(static_cast<int>(point[k] * 50));
            EXPECT_EQ(slices.size(), 50u) << "dimension " << k;
        }
    }
}

TEST(Design, SobolPointsAreEvenAndInTheCube) {
    for (unsigned const seed : {1u, 2u, 77u}) {
        auto const points = scenario::sample_cube(scenario::SampleMethod::sobol, 256, 5, seed);
        for (std::size_t k = 0; k < 5; ++k) {
            double sum = 0;
            for (auto const& point : points) {
                EXPECT_TRUE(point[k] >= 0 && point[k] < 1);
                sum += point[k];
            }
            EXPECT_NEAR(sum / 256, 0.5, 2.0 / 256) << "dimension " << k;
            std::vector<int> quarters(4);
            for (auto const& point : points) ++quarters[static_cast<std::size_t>(point[k] * 4)];
            for (int const count : quarters) EXPECT_NEAR(count, 64, 2);
        }
    }
}

TEST(Design, TheSeedMakesTheSample) {
    for (auto const method : {scenario::SampleMethod::sobol, scenario::SampleMethod::latin_hypercube}) {
        EXPECT_EQ(scenario::sample_cube(method, 20, 3, 5), scenario::sample_cube(method, 20, 3, 5));
        EXPECT_NE(scenario::sample_cube(method, 20, 3, 5), scenario::sample_cube(method, 20, 3, 6));
    }
}

TEST(Design, SamplesStayInTheirRanges) {
    for (char const* method : {"sobol", "latin-hypercube"}) {
        auto const campaign =
            parse(std::string("[sample]\nmethod = \"") + method +
                  "\"\ncount = 40\nseed = 3\n\"trough.throw_number\" = { from = 1, to = 3 }\n"
                  "\"layer.grains\" = { from = 100, to = 200 }\n");
        ASSERT_EQ(campaign.cases.size(), 40u);
        std::set<double> distinct;
        for (scenario::Scenario const& scenario : campaign.cases) {
            EXPECT_GE(throw_number(scenario.trough), 1 - 1e-12);
            EXPECT_LT(throw_number(scenario.trough), 3);
            EXPECT_GE(scenario.layer.grains, 100);
            EXPECT_LE(scenario.layer.grains, 200);
            distinct.insert(scenario.trough.frequency);
        }
        EXPECT_EQ(distinct.size(), 40u);
    }
}

TEST(Design, MistakesAreOneLineWithTheirPlace) {
    for (auto const& [design, part] : std::vector<std::pair<std::string, std::string>>{
             {"[zip]\n\"trough.friction\" = [0.1, 0.2]\n\"grains.friction\" = [0.4]\n",
              "give zipped lists the same length"},
             {"[zip]\n\"trough.fricton\" = [0.1]\n", "did you mean trough.friction?"},
             {"[zip]\n\"campaign.name\" = [\"a\"]\n", "cannot be varied"},
             {"[[points]]\n\"trough.friction\" = 9\n", "out of range"},
             {"[[points]]\n\"trough.friction\" = 0.1\n[[points]]\n\"grains.friction\" = 0.1\n",
              "different keys than"},
             {"[sweep]\n\"trough.friction\" = [0.1]\n[zip]\n\"trough.friction\" = [0.2]\n", "is also varied"},
             {"[zip]\n\"trough.throw_number\" = [1]\n\"trough.machine_number\" = [2]\n", "is also varied"},
             {"[sample]\nmethod = \"random\"\ncount = 3\n", "neither \"sobol\" nor"},
             {"[sample]\nmethod = \"sobol\"\n\"trough.friction\" = { from = 0, to = 1 }\n", "count"},
             {"[sample]\nmethod = \"sobol\"\ncount = 3\n\"trough.friction\" = { from = 1, to = 0 }\n",
              "range is empty"},
             {"[points_from]\nfile = \"../secret.csv\"\n", "not the plain name"},
             {"[points_from]\nfile = \"/etc/passwd\"\n", "not the plain name"},
             {"[points_from]\nfile = \"no_such.csv\"\n", "no_such.csv"},
             {"[[exclude]]\n\"trough.friction\" = { above = 0 }\n", "all cases are left out"},
             {"[[exclude]]\n\"trough.friction\" = { over = 0 }\n", "is not a bound"},
         }) {
        std::string const message = refusal(design);
        EXPECT_TRUE(message.starts_with("c.toml:")) << message;
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

}  // namespace
}  // namespace vibrotrough
