#include "learn/model_errors.hpp"

#include "atlas/tables.hpp"
#include "learn/uncertain.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

/// The rows of a model in validation/model_errors/errors.csv, as model_errors.cpp has them.
std::vector<std::string> stored(std::string const& model) {
    std::ifstream table(VALIDATION_FOLDER "/model_errors/errors.csv");
    std::vector<std::string> rows;
    for (std::string line; std::getline(table, line);) {
        if (line.rfind(model + ",", 0) != 0) continue;
        std::istringstream cells(line.substr(model.size() + 1));
        std::vector<double> n;
        for (std::string cell; std::getline(cells, cell, ',');) n.push_back(std::stod(cell));
        rows.push_back(fmt::format("{{{{{}, {}}}, {{{}, {}}}, {{{}, {}}}, {}, {}}},", n.at(0), n.at(1),
                                   n.at(2), n.at(3), n.at(4), n.at(5), n.at(6), n.at(10)));
    }
    return rows;
}

std::vector<std::string> known(std::span<ModelError const> errors) {
    std::vector<std::string> rows;
    for (ModelError const& e : errors)
        rows.push_back(fmt::format("{{{{{}, {}}}, {{{}, {}}}, {{{}, {}}}, {}, {}}},", e.throw_number.low,
                                   e.throw_number.high, e.tan_inclination.low, e.tan_inclination.high,
                                   e.depth.low, e.depth.high, e.layers, e.sd));
    return rows;
}

// The program's copy is the stored table, digit by digit; the expected rows can be pasted.
TEST(ModelErrors, AreThoseOfTheStoredTable) {
    EXPECT_EQ(known(point_mass_errors()), stored("point mass"));
    EXPECT_EQ(known(rolling_layer_errors()), stored("rolling layer"));
    EXPECT_GE(point_mass_errors().size(), 10U);
}

/// The rows of a table of validation/atlas, each number by its column; empty cells are left out.
std::vector<std::map<std::string, double>> layers_of_atlas(std::string const& name) {
    std::ifstream table(VALIDATION_FOLDER "/atlas/" + name);
    std::set<std::string> const words{"case", "layer_mode", "outcome"};
    std::vector<std::string> columns;
    std::vector<std::map<std::string, double>> rows;
    for (std::string line; std::getline(table, line);) {
        if (line.starts_with('#')) continue;
        std::istringstream cells(line);
        std::map<std::string, double> row;
        std::size_t column = 0;
        bool const is_header = columns.empty();
        for (std::string cell; std::getline(cells, cell, ','); ++column) {
            if (is_header)
                columns.push_back(cell);
            else if (!cell.empty() && !words.contains(columns[column]))
                row[columns[column]] = std::stod(cell);
        }
        if (!row.empty()) rows.push_back(row);
    }
    return rows;
}

// What design_model.hpp and src/manual/design_models.md say: with the grains' rolling friction in its dry
// torque, the law misses layers that roll against friction by no more than its errors for free spheres, 1.96
// sd, mostly.
TEST(ModelErrors, OfTheLawHoldForGrainsThatRollAgainstFriction) {
    int known = 0, held = 0, level = 0, level_held = 0;
    for (char const* const table : {"layers.csv", "held_out.csv"}) {
        for (auto const& row : layers_of_atlas(table)) {
            if (row.at("rolling_friction") <= 0.03 || !row.contains("efficiency") ||
                !row.contains("rolling_layer"))
                continue;
            auto const sd = known_error(rolling_layer_errors(), row.at("throw_number"),
                                        row.at("tan_inclination"), row.at("depth"));
            if (!sd) continue;
            bool const is_held = std::abs(row.at("efficiency") - row.at("rolling_layer")) <= 1.96 * *sd;
            bool const is_level = std::abs(row.at("tan_inclination")) < 0.02 &&
                                  row.at("throw_number") >= 1.25 && row.at("throw_number") < 2.1;
            ++known;
            held += is_held ? 1 : 0;
            level += is_level ? 1 : 0;
            level_held += is_level && is_held ? 1 : 0;
        }
    }
    EXPECT_EQ(known, 207);
    EXPECT_EQ(held, 194);
    EXPECT_EQ(level, 22);
    EXPECT_EQ(level_held, 16);
}

// The rolling friction that nobody knows is anything that the layers of the atlas have.
TEST(ModelErrors, AnUnknownRollingFrictionIsThatOfTheAtlas) {
    auto const& range = atlas::inputs()[atlas::rolling_friction_input];
    EXPECT_EQ(unknown_rolling_friction().low(), range.low);
    EXPECT_EQ(unknown_rolling_friction().high(), range.high);
}

// A place is in one region; without a depth the worst of all depths counts; nothing is known outside of all.
TEST(ModelErrors, AreLookedUpByThrowNumberSlopeAndDepth) {
    auto const law = rolling_layer_errors();
    double const shallow = known_error(law, 1.8, 0, 4).value(), deep = known_error(law, 1.8, 0, 12).value();
    EXPECT_NE(shallow, deep);
    EXPECT_EQ(known_error(law, 1.8, 0, {}), std::max(shallow, deep));
    EXPECT_GT(known_error(law, 1.8, 0.06, 4).value(), shallow) << "the law overstates slopes";
    EXPECT_EQ(known_error(law, 1.8, 0, 16), deep) << "the last edge belongs to the last region";
    EXPECT_FALSE(known_error(law, 1.8, 0, 16.1));
    EXPECT_FALSE(known_error(law, 1.8, 0.2, 4));
    EXPECT_FALSE(known_error(law, 3.1, 0, 4));
    EXPECT_TRUE(known_error(point_mass_errors(), 3.0, 0, 4));
    EXPECT_FALSE(known_error(point_mass_errors(), 2.0, 0, 15)) << "no layer without rotation is so deep";
    EXPECT_GE(largest_error(law), deep);
    EXPECT_EQ(largest_throw_number(law), 3.0);
}

// Two layers tell an error of 0.026 / 4.303 * 1.96 (rms), which is distributed as Student's t: t(0.975; 2)
// = 4.303, t(0.995; 2) = 9.925 (tables have four digits). Up to 97.5 % the standard deviation is that of the
// table.
TEST(ModelErrors, FewLayersHaveLongTails) {
    auto const sd = [](double confidence) {
        theory::Drive const of_throw_number_1{10, 0.00993, 0.25, 0};
        return point_mass_design_model().missed(of_throw_number_1, 4.0, confidence);
    };
    EXPECT_EQ(sd(0.95), 0.026);
    EXPECT_EQ(sd(0.975), 0.026);
    EXPECT_NEAR(sd(0.995), 0.026 * (9.925 / 2.5758) / (4.303 / 1.96), 1e-4 * 0.026);
}

}  // namespace
}  // namespace vibrotrough::learn
