#include "prepare/numerical_errors.hpp"

#include "core/atomic_file.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/model/softness.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::prepare {
namespace {

namespace fs = std::filesystem;

scenario::Scenario prepared_scenario(std::string const& text) {
    return prepare_case(scenario::parse_campaign(text, "example.toml").cases.front()).scenario;
}

/// A layer of a depth in a box, all in diameters.
scenario::Scenario layer(double length, double width, double depth) {
    scenario::Scenario s = prepared_scenario(example_campaign);
    s.layer.length = length * s.grains.diameter;
    s.layer.width = width * s.grains.diameter;
    s.layer.height = depth * s.grains.diameter;
    return s;
}

struct Mean {
    double efficiency, half_width;
};

/// {"length": {"24 mm": mean, ...}, ...} from the stored result of validation/convergence.
std::map<std::string, std::map<std::string, Mean>> stored_means() {
    std::map<std::string, std::map<std::string, Mean>> means;
    std::istringstream file(core::read_file(fs::path(VALIDATION_FOLDER) / "convergence" / "result.csv"));
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

// 0.019 * 40 d^2 / (L W) up to 8 diameters; deeper 0.03 sqrt(40 d^2 / (L W)), from 12 diameters on with the
// depth. Between side walls the width does not count.
TEST(NumericalErrors, TheBoxCountsWithItsArea) {
    EXPECT_NEAR(box_error(layer(8, 5, 4)), 0.019, 1e-12);
    EXPECT_NEAR(box_error(layer(16, 10, 4)), 0.019 / 4, 1e-12);
    EXPECT_NEAR(box_error(layer(16, 10, 12)), 0.015, 1e-12);
    EXPECT_NEAR(box_error(layer(8, 5, 20)), 0.05, 1e-12);
    scenario::Scenario walls = layer(8, 50, 4);
    walls.trough.side_wall_friction = 0.2;
    EXPECT_NEAR(box_error(walls), 0.019, 1e-12);
}

// The factors are those of the stored model: the half-width of what is left of a new layer's error, with the
// mean m in it where the model would correct it, q x sqrt(t^2 + (h / q)^2 + m^2), h the half-width of m. The
// quantile q of Student's distribution is near 2.1; three digits of the factors are kept.
TEST(NumericalErrors, TheFactorsAreThoseOfTheStudy) {
    std::istringstream file(core::read_file(fs::path(VALIDATION_FOLDER) / "numerics" / "model.csv"));
    std::map<std::string, std::vector<std::vector<double>>> model;
    for (std::string line; std::getline(file, line);) {
        std::istringstream cells(line);
        std::string name, cell;
        std::getline(cells, name, ',');
        if (name != "softness" && name != "box" && name != "step") continue;
        auto& row = model[name].emplace_back();
        while (std::getline(cells, cell, ',')) row.push_back(cell == "inf" ? 99 : std::stod(cell));
    }
    enum { from, to, layers, mean, mean_half_width, deviation, least, most, correction, half_width };
    auto const whole = [](std::vector<double> const& row) {
        return row.at(correction) == 0 ? row.at(half_width)
                                       : std::hypot(row.at(half_width), 2.09 * row.at(mean) * 0.0064);
    };
    scenario::Scenario s = layer(8, 5, 4);
    double const modulus = 5e6;
    ASSERT_EQ(model["softness"].size(), 3U);
    for (auto const& row : model["softness"]) {
        s.trough.given.throw_number = row.at(from) + 0.1;
        double const square = std::pow(scenario::wave_number(s, modulus), 2);
        EXPECT_NEAR(softness_error(s, modulus) / square, whole(row) / 0.0064, 0.05) << row.at(from);
    }
    EXPECT_NEAR(box_error(layer(8, 5, 4)), model["box"].front().at(half_width), 5e-4);
    EXPECT_NEAR(numerical_errors(layer(8, 5, 4)).time_step, model["step"].front().at(half_width), 5e-4);
}

// Each setting that validation/convergence varied (6 diameters wide or 12 long, four deep) differs from its
// limit by no more than the bound and its own interval.
TEST(NumericalErrors, TheBoundHoldsInTheStoredStudyOfBoxes) {
    auto const means = stored_means();
    auto const error = [](Mean const& value, Mean const& limit) {
        return std::abs(value.efficiency - limit.efficiency) - std::hypot(value.half_width, limit.half_width);
    };
    for (int const length : {8, 12, 24}) {
        std::string const text = fmt::format("{} mm", 3 * length);
        EXPECT_LE(error(means.at("length").at(text), means.at("length").at("144 mm")),
                  box_error(layer(length, 6, 4)))
            << text;
    }
    for (int const width : {5, 6, 12}) {
        std::string const text = fmt::format("{} mm", 3 * width);
        EXPECT_LE(error(means.at("width").at(text), means.at("width").at("72 mm")),
                  box_error(layer(12, width, 4)))
            << text;
    }
    EXPECT_LE(error(means.at("time_step").at("0.2"), means.at("time_step").at("0.1")),
              numerical_errors(layer(12, 6, 4)).time_step);
}

TEST(NumericalErrors, TheirTotalIsTheRootOfTheSumOfSquares) {
    EXPECT_DOUBLE_EQ((NumericalErrors{0.02, 0.03, 0.06}).total(), 0.07);
    EXPECT_DOUBLE_EQ(whole_half_width(0.24, {0.02, 0.03, 0.06}), 0.25);
    scenario::Scenario const s = layer(8, 5, 4);
    EXPECT_EQ(numerical_errors(s).softness, softness_error(s, *s.grains.youngs_modulus));
}

// What is left: 0.05^2 = 0.04^2 + 0.03^2.
TEST(NumericalErrors, StatisticsGetWhatIsLeft) {
    scenario::Scenario s = layer(8, 5, 4);
    double const numerics = numerical_errors(s).total();
    s.measure.half_width = numerics / 0.8;
    scenario::MeasurementPlan const plan = statistics_plan(s);
    EXPECT_NEAR(plan.half_width, 0.6 / 0.8 * numerics, 1e-12);
    EXPECT_NEAR(whole_half_width(plan.half_width, numerical_errors(s)), s.measure.half_width, 1e-12);
    EXPECT_EQ(plan.max_packings, s.measure.max_packings) << "the rest of the plan stays";
    EXPECT_TRUE(can_be_finished(s));
}

TEST(NumericalErrors, MayBeTooLargeToFinish) {
    scenario::Scenario s = layer(8, 5, 4);
    s.measure.half_width = numerical_errors(s).total();
    EXPECT_FALSE(can_be_finished(s));
    EXPECT_EQ(statistics_plan(s).half_width, s.measure.half_width) << "more packings would not help";
    s.measure.half_width = 1.0001 * numerical_errors(s).total() / largest_numerical_share;
    EXPECT_TRUE(can_be_finished(s));
}

}  // namespace
}  // namespace vibrotrough::prepare
