#include "theory/tested_range.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

using Row = std::map<std::string, std::string>;

/// The free layers of validation/rolling_layer with their inputs, as validation/model_errors lists them.
std::vector<Row> held_out() {
    std::ifstream table(VALIDATION_FOLDER "/model_errors/layers.csv");
    std::vector<std::string> names;
    std::vector<Row> rows;
    for (std::string line; std::getline(table, line);) {
        if (line.empty() || line.front() == '#') continue;
        std::istringstream cells(line);
        std::vector<std::string> all;
        for (std::string cell; std::getline(cells, cell, ',');) all.push_back(cell);
        if (names.empty()) {
            names = all;
            continue;
        }
        Row row;
        for (std::size_t i = 0; i < names.size() && i < all.size(); ++i) row[names[i]] = all[i];
        if (row["source"] == "rolling_layer" && row["grains"] != "blocked") rows.push_back(row);
    }
    return rows;
}

/// The throw numbers between which validation/rolling_layer judges the laws: JUDGED = (1.25, 2.6).
Range judged() {
    std::ifstream script(VALIDATION_FOLDER "/rolling_layer/held_out.py");
    for (std::string line; std::getline(script, line);) {
        Range range{};
        if (std::sscanf(line.c_str(), "JUDGED = (%lf, %lf)", &range.low, &range.high) == 2) return range;
    }
    return {};
}

double number(Row const& row, char const* name) {
    return std::stod(row.at(name));
}

template <class Condition>
Range range_of(char const* name, Condition const& condition) {
    Range range{1e9, -1e9};
    for (Row const& row : held_out()) {
        if (!condition(row)) continue;
        range = {std::min(range.low, number(row, name)), std::max(range.high, number(row, name))};
    }
    return range;
}

void expect_equal(Range const& a, Range const& b) {
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
}

// The range is that of the layers to which the law was not fitted, and no wider.
TEST(TestedRange, IsThatOfTheHeldOutLayers) {
    ASSERT_GE(held_out().size(), 40U);
    auto const any = [](Row const&) { return true; };
    auto const sloping = [](Row const& row) { return number(row, "tan_inclination") != 0; };
    auto const at_depth = [](double depth) {
        return [depth](Row const& row) { return number(row, "depth") == depth; };
    };
    expect_equal(tested_level.throw_number, judged());
    expect_equal(tested_slopes.throw_number, range_of("throw_number", sloping));
    expect_equal({-tested_slopes.slope, tested_slopes.slope}, range_of("tan_inclination", any));
    expect_equal({tested_shallow.depth, tested_deep.depth}, range_of("depth", any));
    expect_equal(tested_shallow.throw_number, range_of("throw_number", at_depth(tested_shallow.depth)));
    expect_equal(tested_deep.throw_number, range_of("throw_number", at_depth(tested_deep.depth)));
    expect_equal({tested_level.depth, tested_slopes.depth}, range_of("depth", sloping));
    expect_equal(tested_tan_vibration_angle, range_of("tan_vibration_angle", any));
    expect_equal(tested_friction, range_of("friction", any));
    for (Row const& row : held_out()) {
        double const gamma = number(row, "throw_number");
        auto const why = outside_tested_range({gamma, number(row, "tan_vibration_angle"),
                                               number(row, "tan_inclination"), number(row, "friction")},
                                              number(row, "depth"));
        EXPECT_EQ(why.has_value(), gamma < judged().low || gamma > judged().high) << row.at("group") << gamma;
    }
}

// Between the series the range is their convex hull: half way to the steepest slope half of both ends.
TEST(TestedRange, NarrowsWithSlopeAndDepth) {
    auto const half = tested_throw_numbers(-0.04).value();
    EXPECT_NEAR(half.low, (1.25 + 1.6) / 2, 1e-12);
    EXPECT_NEAR(half.high, (2.6 + 2.3) / 2, 1e-12);
    EXPECT_NEAR(tested_throw_numbers(0, 10).value().high, (2.6 + 1.9) / 2, 1e-12);
    EXPECT_FALSE(tested_throw_numbers(0.05, 14)) << "deep layers were level";
    EXPECT_FALSE(tested_throw_numbers(0, 2.9));
    EXPECT_FALSE(tested_throw_numbers(0, 16.1));
}

// The two points that were once printed without a word, and the layer whose design was refuted.
TEST(TestedRange, SaysWhatIsOutside) {
    EXPECT_EQ(outside_tested_range({2.8, 0.5, -0.06, 0.3}).value(),
              "the rolling-layer law has not been tested at throw_number = 2.8, tan_inclination = -0.06 "
              "(-3.434 deg), where it has been for throw numbers in [1.513, 2.375]");
    EXPECT_TRUE(outside_tested_range({2.75, 0.5, -0.06, 0.3}));
    EXPECT_FALSE(outside_tested_range({2.4, 0.5, 0, 0.3}));
    EXPECT_TRUE(outside_tested_range({2.4, 0.5, 0, 0.3}, 15.6));
    EXPECT_FALSE(outside_tested_range({1.9, 0.5, 0, 0.3}, 15.6));
    EXPECT_TRUE(outside_tested_range({1.9, 0.5, 0, 0.7}));
    EXPECT_TRUE(outside_tested_range({1.9, 0.8, 0, 0.3}));
}

// The excess of a drive is the relative distance of its throw number from the range at its slope.
TEST(TestedRange, ExcessOfADrive) {
    double const beta = std::atan(0.5);
    auto const drive = [&](double throw_number, double slope) {
        double const alpha = std::atan(slope), amplitude = 0.006;
        double const omega = std::sqrt(throw_number * 9.81 * std::cos(alpha) / (amplitude * std::sin(beta)));
        return Drive{omega / (2 * std::numbers::pi), amplitude, beta, alpha};
    };
    EXPECT_NEAR(tested_excess(drive(2.6 * 1.1, 0)), 0.1, 1e-9);
    EXPECT_NEAR(tested_excess(drive(1.25 * 0.9, 0)), 0.1, 1e-9);
    EXPECT_NEAR(tested_excess(drive(1.8, 0.16)), 1, 1e-9);
    EXPECT_LT(tested_excess(drive(2, 0.05)), 0);
}

}  // namespace
}  // namespace vibrotrough::theory
