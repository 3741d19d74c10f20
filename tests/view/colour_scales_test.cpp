#include "view/colour_scales.hpp"

#include <gtest/gtest.h>

namespace vibrotrough::view {
namespace {

// The colours reach as far as 95 % of the values of a mean frame, rounded up to 1, 2 or 5.
TEST(ColourScales, AreRoundNumbers) {
    EXPECT_EQ(rounded_up(0.0), 0.0);
    EXPECT_DOUBLE_EQ(rounded_up(0.05), 0.05);
    EXPECT_DOUBLE_EQ(rounded_up(0.0501), 0.1);
    EXPECT_DOUBLE_EQ(rounded_up(1.1), 2.0);
    EXPECT_DOUBLE_EQ(rounded_up(201.0), 500.0);
    ColourScales scales;
    EXPECT_EQ(scales.velocity(), 0.0);
    std::vector<float> values;
    for (int i = 1; i <= 101; ++i) values.push_back(static_cast<float>(i % 2 == 0 ? i : -i));
    scales.add(values, {}, values);  // 96 is at 95 %
    EXPECT_DOUBLE_EQ(scales.velocity(), 100.0);
    EXPECT_EQ(scales.spin(), 0.0);
    std::vector<float> const still(101, 0.0F);
    scales.add(still, {}, still);  // the mean is 48
    EXPECT_DOUBLE_EQ(scales.height(), 50.0);
}

}  // namespace
}  // namespace vibrotrough::view
