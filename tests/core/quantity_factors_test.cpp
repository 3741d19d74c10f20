#include "core/quantity.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::core {
namespace {

// udunits2 takes "deg deg" for the square of a pure number and "mm %" for a hundredth of a millimetre.
TEST(Quantity, PureNumbersAreNoFactors) {
    for (char const* slip :
         {"5 deg deg", "5 deg.deg", "5 deg rad", "3 mm %", "3 % mm", "3 mm percent", "3 mm*deg"}) {
        EXPECT_THROW(parse_quantity(slip, "m"), QuantityError) << slip;
        EXPECT_THROW(parse_quantity(slip, "radian"), QuantityError) << slip;
    }
    EXPECT_DOUBLE_EQ(parse_quantity("5 deg", "radian"), 5 * std::numbers::pi / 180);
    EXPECT_DOUBLE_EQ(parse_quantity("3 mm", "m"), 0.003);
    EXPECT_DOUBLE_EQ(parse_quantity("9 kg m-1 s-2", "Pa"), 9);
    EXPECT_DOUBLE_EQ(parse_quantity("2 N.m-2", "Pa"), 2);
}

}  // namespace
}  // namespace vibrotrough::core
