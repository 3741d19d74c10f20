#include "core/typed_unit.hpp"

#include "core/quantity.hpp"
#include "core/text.hpp"

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

// pi/2 rad = 90 deg, 0.01 Hz = 0.6 rpm. Tolerance: the six digits of the text.
TEST(TypedUnit, ARangeIsInTheUnitThatWasWritten) {
    double const right_angle = 1.5707963267948966;
    EXPECT_EQ(core::range_in_unit_of("95 deg", -right_angle, right_angle, "radian"), "-90 to 90 deg");
    EXPECT_EQ(core::range_in_unit_of("2 rad", -right_angle, right_angle, "radian", " and "),
              "-1.5708 and 1.5708 rad");
    EXPECT_EQ(core::range_in_unit_of("7e5 rpm", 0.01, 1e4, "Hz"), "0.6 to 600000 rpm");
    EXPECT_THROW(core::range_in_unit_of("9 mm", 0, 1, "Hz"), core::QuantityError);
}

// The slip of the issue: mm for m, rpm for Hz, degrees for radians, m/min for m/s, t/m3 for kg/m3.
TEST(TypedUnit, TheSlipThatExplainsANumberIsNamed) {
    EXPECT_EQ(core::slip_of_unit("9.7 m", 2e-6, 2, "m"), " (were 9.7 mm meant?)");
    EXPECT_EQ(core::slip_of_unit("9600 mm", 3, 20, "m"), "") << "it is within the range as it stands";
    EXPECT_EQ(core::slip_of_unit("96000 Hz", 0.01, 1e4, "Hz"), " (were 96000 rpm meant?)");
    EXPECT_EQ(core::slip_of_unit("0.1 rpm", 0.01, 1e4, "Hz"), " (were 0.1 Hz meant?)");
    EXPECT_EQ(core::slip_of_unit("30 rad", 0, 1.55, "radian"), " (were 30 deg meant?)");
    EXPECT_EQ(core::slip_of_unit("0.6 kg/m3", 1, 3e4, "kg/m3"), " (were 0.6 t/m3 meant?)");
    EXPECT_EQ(core::slip_of_unit("1200 m/s", -1000, 1000, "m/s"), " (were 1200 m/min meant?)");
    EXPECT_EQ(core::slip_of_unit("1e9 m", 2e-6, 2, "m"), "") << "no slip explains it";
}

TEST(TypedUnit, NumbersArePlain) {
    EXPECT_EQ(core::plain_number(12000, 4), "12000");
    EXPECT_EQ(core::plain_number(1149.6, 3), "1150");
    EXPECT_EQ(core::plain_number(-1149.6, 3), "-1150");
    EXPECT_EQ(core::plain_number(999.6, 3), "1000");
    EXPECT_EQ(core::plain_number(52.84, 3), "52.8");
    EXPECT_EQ(core::plain_number(0.0431, 3), "0.0431");
    EXPECT_EQ(core::plain_number(0, 3), "0");
}

}  // namespace
}  // namespace vibrotrough
