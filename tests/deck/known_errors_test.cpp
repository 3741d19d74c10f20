#include "deck/known_errors.hpp"

#include "core/atomic_file.hpp"
#include "deck/check.hpp"
#include "deck/estimates.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

namespace fs = std::filesystem;
fs::path const study = CONVERGENCE_FOLDER;

struct Mean {
    double efficiency, half_width;
};

/// {"length": {"24 mm": mean, ...}, ...} from the stored result of validation/convergence.
std::map<std::string, std::map<std::string, Mean>> stored_means() {
    std::map<std::string, std::map<std::string, Mean>> means;
    std::istringstream file(core::read_file(study / "result.csv"));
    for (std::string line; std::getline(file, line);) {
        std::istringstream cells(line);
        std::string variation, value, efficiency, half_width;
        if (!std::getline(cells, variation, ',') || !std::getline(cells, value, ',') ||
            !std::getline(cells, efficiency, ',') || !std::getline(cells, half_width, ','))
            continue;
        if (efficiency.find_first_not_of("0123456789.") != std::string::npos) continue;
        means[variation][value] = {std::stod(efficiency), std::stod(half_width)};
    }
    return means;
}

/// The stored study's case with one line of its text replaced.
prepare::PreparedCase studied(std::string const& from = "", std::string const& to = "") {
    std::string text = core::read_file(study / "base.toml");
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    return prepare::prepare_case(scenario::parse_campaign(text, "base.toml").cases.front());
}

void expect_error(KnownError const& known, Mean const& value, Mean const& limit) {
    // Four digits in both tables.
    EXPECT_NEAR(known.error, value.efficiency - limit.efficiency, 1.1e-4) << known.at;
    EXPECT_NEAR(known.half_width, std::hypot(value.half_width, limit.half_width), 1.1e-4) << known.at;
}

// The table is that of validation/convergence: value minus limit, half-widths in squares.
TEST(KnownErrors, AreThoseOfTheStoredStudy) {
    auto const means = stored_means();
    auto const lengths = known_length_errors(), widths = known_width_errors();
    for (auto const& [index, length] : {std::pair{0, "24 mm"}, {1, "36 mm"}, {2, "72 mm"}})
        expect_error(lengths[static_cast<std::size_t>(index)], means.at("length").at(length),
                     means.at("length").at("144 mm"));
    for (auto const& [index, width] : {std::pair{0, "15 mm"}, {1, "18 mm"}, {2, "36 mm"}})
        expect_error(widths[static_cast<std::size_t>(index)], means.at("width").at(width),
                     means.at("width").at("72 mm"));
}

TEST(KnownErrors, HaveTheMeasuresOfTheStudy) {
    EXPECT_EQ(known_length_errors()[1].measure, 1.0 / 12) << "36 mm of grains of 3 mm";
    EXPECT_EQ(known_width_errors()[0].measure, 1.0 / 5);
}

TEST(KnownErrors, ApplyToWhatIsNoNearerToTheLimit) {
    auto const at = [](double diameters) {
        return largest_known_error(known_length_errors(), 1 / diameters);
    };
    EXPECT_EQ(at(6)->at, "8 diameters") << "shorter than all that were studied";
    EXPECT_EQ(at(8)->at, "8 diameters");
    EXPECT_EQ(at(10)->at, "12 diameters") << "an error was found even in a longer box";
    EXPECT_EQ(at(12)->at, "12 diameters");
    EXPECT_FALSE(at(13)) << "the longer box that was studied shows no error beyond its interval";
    EXPECT_FALSE(largest_known_error(known_width_errors(), 1.0 / 6)) << "0.015 +- 0.016 is no error found";
}

Finding finding(scenario::Scenario const& s, std::string const& key, std::string const& part) {
    auto const all = check(prepare::prepare_case(s));
    auto const found = std::ranges::find_if(
        all, [&](Finding const& one) { return one.key == key && one.item.find(part) != std::string::npos; });
    if (found == all.end()) throw std::out_of_range(key);
    return *found;
}

// The study's own layer: 0.024 at 12 diameters is more than 0.02 and less than 0.03.
TEST(KnownErrors, WarnWhenTheyAreAboveTheHalfWidth) {
    scenario::Scenario s = studied().scenario;
    for (double const half_width : {0.02, 0.03}) {
        s.measure.half_width = half_width;
        Severity const expected = half_width < 0.024 ? Severity::warning : Severity::fine;
        EXPECT_EQ(finding(s, "layer.length", "known").severity, expected);
        EXPECT_EQ(finding(s, "layer.width", "known").severity, Severity::fine);
    }
    s.measure.half_width = 0.02;
    std::string const advice = finding(s, "layer.length", "known").advice;
    EXPECT_EQ(advice,
              "validation/convergence found +0.024 +- 0.017 at 12 diameters; lengthen the box, or measure it "
              "with 'vibrotrough convergence'");
    s.layer.length = 0.075;
    EXPECT_EQ(finding(s, "layer.length", "known").severity, Severity::fine);
    s.layer.width = 0.014;
    EXPECT_EQ(finding(s, "layer.width", "known").severity, Severity::warning);
    s.trough.side_wall_friction = 0.2;
    EXPECT_THROW(finding(s, "layer.width", "known"), std::out_of_range) << "the width is part of the problem";
}

// Spheres of 1 mm and 30 mm: beyond the ratio of 20 that the probe has shown to be right.
TEST(SizeRatio, WarnsBeyondWhatWasProbed) {
    scenario::Scenario s = studied().scenario;
    EXPECT_NEAR(finding(s, "grains.diameter_spread", "largest sphere").measured, 3.3 / 2.7, 1e-9);
    EXPECT_EQ(finding(s, "grains.diameter_spread", "largest sphere").severity, Severity::fine);
    s.grains.size_law = scenario::SizeLaw::listed;
    s.grains.number_fractions = {0.5, 0.5};
    s.grains.diameters = {0.001, 0.019};
    EXPECT_EQ(finding(s, "grains.diameters", "largest sphere").severity, Severity::fine);
    s.grains.diameters = {0.001, 0.021};
    Finding const beyond = finding(s, "grains.diameters", "largest sphere");
    EXPECT_EQ(beyond.severity, Severity::warning);
    EXPECT_NE(beyond.advice.find("Vyas"), std::string::npos);
}

// A clump of spheres of 1 and 25 units: its own spheres meet those of its neighbours.
TEST(SizeRatio, CountsTheSpheresOfAClump) {
    scenario::Scenario s = studied().scenario;
    s.grains.diameter_spread = 0;
    s.grains.shape = "comet.csv";
    s.grains.shape_file = scenario::read_shape({"comet.csv", "x,y,z,radius\n0,0,0,25\n25,0,0,1\n"});
    Finding const beyond = finding(s, "grains.shape", "largest sphere");
    EXPECT_NEAR(beyond.measured, 25, 1e-9);
    EXPECT_EQ(beyond.severity, Severity::warning);
}

}  // namespace
}  // namespace vibrotrough::deck
