#include "core/quantity.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

// Unit conversion is a product of a few doubles: a relative error of some 1e-16 each.
constexpr double rounding = 1e-14;

TEST(Quantity, ReadsUnitsIntoSi) {
    EXPECT_NEAR(core::parse_quantity("6 mm", "m"), 6e-3, 6e-3 * rounding);
    EXPECT_NEAR(core::parse_quantity("30 deg", "radian"), std::acos(-1.0) / 6, rounding);
    EXPECT_NEAR(core::parse_quantity("-3 degree", "radian"), -std::acos(-1.0) / 60, rounding);
    EXPECT_NEAR(core::parse_quantity("12.9 Hz", "Hz"), 12.9, 12.9 * rounding);
    EXPECT_NEAR(core::parse_quantity("340 / minute", "Hz"), 340.0 / 60, 6 * rounding);
    EXPECT_NEAR(core::parse_quantity("1.4 g/cm3", "kg/m3"), 1400, 1400 * rounding);
    EXPECT_NEAR(core::parse_quantity("12.9 s^-1", "Hz"), 12.9, 12.9 * rounding);
    EXPECT_NEAR(core::parse_quantity("1.4 g/cm^3", "kg/m3"), 1400, 1400 * rounding);
    EXPECT_NEAR(core::parse_quantity("5 N/mm^2", "Pa"), 5e6, 5e6 * rounding);
    EXPECT_NEAR(core::parse_quantity("5 MPa", "Pa"), 5e6, 5e6 * rounding);
    EXPECT_NEAR(core::parse_quantity("  +2.5e-1m ", "m"), 0.25, rounding);
}

// A cycle per turn: f [Hz] = n [1/min] / 60.
TEST(Quantity, ZeroHasNoSign) {
    for (char const* text : {"-0 deg", "-0.0 rad", "0 deg"})
        EXPECT_FALSE(std::signbit(core::parse_quantity(text, "radian"))) << text;
    EXPECT_LT(core::parse_quantity("-1 deg", "radian"), 0);
}

TEST(Quantity, TurnsAreCycles) {
    for (char const* const text :
         {"1500 rpm", "1500 RPM", "1500 1/min", "1500/min", "1500 min^-1", "25 turns/s", "25 rev / s",
          "1500 r/min", "1500 revolutions per minute", "25 cycles/s", "1500 revolutions_per_minute"}) {
        EXPECT_NEAR(core::parse_quantity(text, "Hz"), 25, 25 * rounding) << text;
    }
    EXPECT_THROW(core::parse_quantity("25 turns", "Hz"), core::QuantityError) << "no time";
    EXPECT_THROW(core::parse_quantity("25 rpm", "m"), core::QuantityError);
    EXPECT_THROW(core::parse_quantity("157 rad/s", "Hz"), core::QuantityError);
    EXPECT_THROW(core::parse_quantity("9000 deg/s", "Hz"), core::QuantityError);
    EXPECT_NEAR(core::parse_quantity("0.25 turn", "radian"), std::acos(-1.0) / 2, rounding) << "of an angle";
}

TEST(Quantity, WhatGermanPlantsWrite) {
    EXPECT_NEAR(core::parse_quantity("960 U/min", "Hz"), 16, 16 * rounding);
    EXPECT_NEAR(core::parse_quantity("960 Umdrehungen / min", "Hz"), 16, 16 * rounding);
    EXPECT_NEAR(core::parse_quantity("12 to/h", "kg/s"), 12 / 3.6, 4 * rounding);
    EXPECT_NEAR(core::parse_quantity("30 Grad", "radian"), std::acos(-1.0) / 6, rounding) << "no giga-radian";
    EXPECT_NEAR(core::parse_quantity("2 m/min", "m/s"), 2.0 / 60, rounding);
    EXPECT_NEAR(core::parse_quantity("20 m3/h", "m3/s"), 20.0 / 3600, rounding);
}

TEST(Quantity, ADecimalCommaIsNamed) {
    auto const message = [](auto const& read) -> std::string {
        try {
            read();
        } catch (core::QuantityError const& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(message([] { core::parse_quantity("9,7 mm", "m"); }),
              "'9,7 mm' has a decimal comma; write 9.7 mm with a point");
    EXPECT_EQ(message([] { core::parse_number("0,3"); }),
              "'0,3' has a decimal comma; write 0.3 with a point");
    EXPECT_EQ(message([] { core::parse_quantity("1,000 mm", "m"); }),
              "'1,000 mm' has a comma; write 1.000 mm with a point, or 1000 mm if thousands are meant");
    EXPECT_NE(message([] { core::parse_number("1,2,3"); }).find("is not a finite number"), std::string::npos);
}

TEST(Quantity, NumbersAndPercentages) {
    EXPECT_EQ(core::parse_number("0.3"), 0.3);
    EXPECT_EQ(core::parse_number("+2e-1 "), 0.2);
    EXPECT_EQ(core::parse_number("10 %"), 0.1);
    EXPECT_EQ(core::parse_number("10%"), 0.1);
    EXPECT_THROW(core::parse_number("10 mm"), core::QuantityError);
    EXPECT_THROW(core::parse_number(""), core::QuantityError);
    EXPECT_THROW(core::parse_number("nan"), core::QuantityError);
}

// m' [kg/s] = 1000 m' [t/h] / 3600.
TEST(Quantity, MassFlowsInTonnesPerHour) {
    EXPECT_NEAR(core::parse_quantity("12 t/h", "kg/s"), 12 / 3.6, 4 * rounding);
    EXPECT_NEAR(core::parse_quantity("12 tonnes per hour", "kg/s"), 12 / 3.6, 4 * rounding);
    EXPECT_NEAR(core::parse_quantity("3600 kg/h", "kg/s"), 1, rounding);
    EXPECT_NEAR(core::parse_quantity("2 short_ton/hour", "kg/s"), 2 * 2000 * 0.45359237 / 3600, rounding);
    for (char const* const text : {"12 tons/h", "12 ton/h", "12 Tons", "12 kg ton"}) {
        try {
            core::parse_quantity(text, "kg/s");
            FAIL() << text;
        } catch (core::QuantityError const& error) {
            EXPECT_NE(std::string(error.what())
                          .find("t for metric tonnes (1000 kg), short_ton (907 kg) or "
                                "long_ton (1016 kg)"),
                      std::string::npos)
                << error.what();
        }
    }
}

// udunits2 reads mt as a thousandth of a tonne. A foot, a pint and a kilogram also end so, and stay.
TEST(Quantity, APrefixOfTonnesIsASlip) {
    for (char const* const text : {"12 mt/h", "12 dt/h", "12 mt", "12 millitonne/h"})
        EXPECT_THROW(core::parse_quantity(text, "kg/s"), core::QuantityError) << text;
    EXPECT_NEAR(core::parse_quantity("62.4 lb/ft3", "kg/m3"), 62.4 * 0.45359237 / std::pow(0.3048, 3), 1e-9);
}

TEST(Quantity, MistakesAreNamed) {
    auto const message = [](char const* text, char const* unit) {
        try {
            core::parse_quantity(text, unit);
        } catch (core::QuantityError const& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(message("6", "m"), "'6' has no unit");
    EXPECT_EQ(message("", "m"), "'' does not begin with a finite number");
    EXPECT_EQ(message("mm", "m"), "'mm' does not begin with a finite number");
    EXPECT_EQ(message("nan m", "m"), "'nan m' does not begin with a finite number");
    EXPECT_EQ(message("inf m", "m"), "'inf m' does not begin with a finite number");
    EXPECT_EQ(message("6 parrots", "m"), "'parrots' is not a known unit (of udunits2)");
    EXPECT_EQ(message("6 s", "m"), "'s' cannot be converted to m");
    EXPECT_EQ(message("6 mm; rm", "m"), "'mm; rm' is not a known unit (of udunits2)");
    // Expressions are refused: udunits2 would read 6 mm 3 as 18 mm.
    EXPECT_EQ(message("6 mm 3", "m"), "'mm 3' is not a plain unit");
    EXPECT_EQ(message("0.6 10 mm", "m"), "'10 mm' is not a plain unit");
    EXPECT_EQ(message("6 mm @ 2", "m"), "'mm @ 2' is not a plain unit");
    EXPECT_EQ(message("6 mm from 2", "m"), "'mm from 2' is not a plain unit");
    EXPECT_EQ(message("0.05 1", "radian"), "'1' is not a plain unit");
    // In udunits2 a radian is the number 1: frequencies would be wrong by a factor of 2 pi.
    // 85 x 60 / (2 pi) = 811.69.
    EXPECT_EQ(message("85 rad/s", "Hz"), "'rad/s' contains an angle, Hz does not; write 811.69 rpm");
    EXPECT_EQ(message("85 rad/s", "1/s"), "'rad/s' contains an angle, 1/s does not");
    EXPECT_EQ(message("5 %", "radian"), "'%' is not a unit of angle");
    EXPECT_EQ(message("1e308 km", "mm"), "'1e308 km' is too large");
}

}  // namespace
}  // namespace vibrotrough
