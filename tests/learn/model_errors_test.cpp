#include "learn/model_errors.hpp"

#include <fstream>
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

}  // namespace
}  // namespace vibrotrough::learn
