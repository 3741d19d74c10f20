#include "core/quantity.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

// Unit conversion is a product of a few doubles: a relative error of some 1e-16 each.
constexpr double rounding = 1e-14;

TEST(Quantity, ReadsUnitsIntoSi) {
    EXPECT_NEAR(parse_quantity("6 mm", "m"), 6e-3, 6e-3 * rounding);
    EXPECT_NEAR(parse_quantity("30 deg", "radian"), std::acos(-1.0) / 6, rounding);
    EXPECT_NEAR(parse_quantity("-3 degree", "radian"), -std::acos(-1.0) / 60, rounding);
    EXPECT_NEAR(parse_quantity("12.9 Hz", "Hz"), 12.9, 12.9 * rounding);
    EXPECT_NEAR(parse_quantity("340 / minute", "Hz"), 340.0 / 60, 6 * rounding);
    EXPECT_NEAR(parse_quantity("1.4 g/cm3", "kg/m3"), 1400, 1400 * rounding);
    EXPECT_NEAR(parse_quantity("5 MPa", "Pa"), 5e6, 5e6 * rounding);
    EXPECT_NEAR(parse_quantity("  +2.5e-1m ", "m"), 0.25, rounding);
}

TEST(Quantity, SaysWhatIsWrong) {
    auto const message = [](char const* text, char const* unit) {
        try {
            parse_quantity(text, unit);
        } catch (QuantityError const& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(message("6", "m"), "'6' has no unit");
    EXPECT_EQ(message("", "m"), "'' does not begin with a finite number");
    EXPECT_EQ(message("mm", "m"), "'mm' does not begin with a finite number");
    EXPECT_EQ(message("nan m", "m"), "'nan m' does not begin with a finite number");
    EXPECT_EQ(message("inf m", "m"), "'inf m' does not begin with a finite number");
    EXPECT_EQ(message("6 parrots", "m"), "'parrots' is not a unit that udunits2 knows");
    EXPECT_EQ(message("6 s", "m"), "'s' cannot be converted to m");
    EXPECT_EQ(message("6 mm; rm", "m"), "'mm; rm' is not a unit that udunits2 knows");
    EXPECT_EQ(message("1e308 km", "mm"), "'1e308 km' is too large");
}

}  // namespace
}  // namespace vibrotrough
