#include "measure/segregation.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

// A layer of height H and one solid fraction, the share f of it above the rest: the centres of mass are at
// H (1 - f / 2) and H (1 - f) / 2, so that S = (z_upper - z_lower) / (H / 2) = 1 whatever f is.
TEST(Segregation, IsOneForALayerThatHasSeparated) {
    constexpr double height = 0.012;
    for (double const share : {0.05, 0.5, 0.8}) {
        std::vector<MaterialSeries> const materials{{{0}, {height * (1 - share) / 2}},
                                                    {{0}, {height * (1 - share / 2)}}};
        std::vector<double> const masses{1 - share, share};
        EXPECT_NEAR(segregation_index(materials, masses, 1, height).front(), 1, 1e-14);  // rounding
        EXPECT_NEAR(segregation_index(materials, masses, 0, height).front(), -1, 1e-14);
    }
}

// The others together: (1 * 2 mm + 3 * 6 mm) / 4 = 5 mm, so that S = (9 mm - 5 mm) / 4 mm = 1.
TEST(Segregation, TheOthersCountByTheirMass) {
    std::vector<MaterialSeries> const materials{{{0}, {0.002}}, {{0}, {0.009}}, {{0}, {0.006}}};
    std::vector<double> const masses{1, 7, 3};
    EXPECT_NEAR(segregation_index(materials, masses, 1, 0.008).front(), 1, 1e-14);
}

TEST(Segregation, IsGivenAtTheEndOfEachCycle) {
    std::vector<MaterialSeries> const materials{{{0, 0, 0}, {0.004, 0.004, 0.004}},
                                                {{0, 0, 0}, {0.004, 0.003, 0.002}}};
    auto const index = segregation_index(materials, std::vector<double>{1, 1}, 1, 0.008);
    ASSERT_EQ(index.size(), 3u);
    EXPECT_NEAR(index[0], 0, 1e-14);
    EXPECT_NEAR(index[1], -0.25, 1e-14);
    EXPECT_NEAR(index[2], -0.5, 1e-14);
    EXPECT_EQ(last_cycles(3), 1);
    EXPECT_EQ(last_cycles(200), 20);
}

// eta = displacement / (2 pi r cos(beta) n): 8 mm in two cycles of r cos(beta) = 4 mm.
TEST(Segregation, EachMaterialHasItsEfficiency) {
    MaterialSeries const material{{0.01, 0.012, 0.016, 0.020}, {0, 0, 0, 0}};
    EXPECT_NEAR(material_efficiency(material, 1, 0.004), 0.008 / (2 * std::numbers::pi * 0.004 * 2), 1e-14);
    EXPECT_TRUE(std::isnan(material_efficiency(material, 3, 0.004)));
}

}  // namespace
}  // namespace vibrotrough::measure
