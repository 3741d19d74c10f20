#include "prepare/clump.hpp"

#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::prepare {
namespace {

using std::numbers::pi;
// The integration uses 400 x 400 lines, so the edges of the outline are known to half a line in 400.
constexpr double grid = 2e-4;

scenario::Grains shaped(std::string const& file) {
    scenario::Grains grains = scenario::parse_campaign(example_campaign, "c").cases.front().grains;
    grains.shape = "shape.csv";
    grains.shape_file = scenario::read_shape({"shape.csv", "x,y,z,radius\n" + file});
    return grains;
}

// One sphere, wherever it is: V = pi d^3 / 6, I = 2/5 V R^2 about its centre.
TEST(Clump, OfOneSphereIsTheSphere) {
    Clump const clump = *make_clump(shaped("7,8,9,2\n"));
    double const radius = 1.5e-3, volume = pi / 6 * 27e-9;
    EXPECT_DOUBLE_EQ(clump.volume, volume);
    EXPECT_NEAR(clump.spheres[0].radius, radius, grid * radius);
    EXPECT_NEAR(clump.spheres[0].x, 0, grid * radius);
    for (std::size_t const i : {0U, 3U, 5U})
        EXPECT_NEAR(clump.inertia[i], 0.4 * volume * radius * radius, 3 * grid * volume * radius * radius);
    for (std::size_t const i : {1U, 2U, 4U}) EXPECT_NEAR(clump.inertia[i], 0, 1e-6 * clump.inertia[0]);
    EXPECT_NEAR(clump.bounding_radius, radius, grid * radius);
}

// Two spheres that touch, along x: I_xx = 2 (2/5 v R^2), I_yy = 2 (2/5 v R^2 + v R^2), v = V / 2.
TEST(Clump, OfTwoTouchingSpheres) {
    Clump const clump = *make_clump(shaped("0,0,0,1\n2,0,0,1\n"));
    double const r = std::cbrt(clump.volume / 2 * 3 / (4 * pi));
    EXPECT_NEAR(clump.spheres[1].x, r, grid * r);
    EXPECT_NEAR(clump.inertia[0], 0.4 * clump.volume * r * r, 2 * grid * clump.volume * r * r);
    EXPECT_NEAR(clump.inertia[3], 1.4 * clump.volume * r * r, 6 * grid * clump.volume * r * r);
    EXPECT_NEAR(clump.inertia[5], clump.inertia[3], 6 * grid * clump.inertia[3]);
}

// A sphere within another one changes nothing, and two identical spheres count as one.
TEST(Clump, CountsOverlapsOnce) {
    Clump const one = *make_clump(shaped("0,0,0,1\n")),
                twice = *make_clump(shaped("0,0,0,1\n0,0,0,1\n0.2,0,0,0.5\n"));
    EXPECT_NEAR(twice.spheres[0].radius, one.spheres[0].radius, 1e-15);
    EXPECT_NEAR(twice.inertia[0], one.inertia[0], 1e-12 * one.inertia[0]);
    EXPECT_NEAR(twice.smallest_radius, one.smallest_radius / 2, 1e-15);
}

// Two overlapping spheres, centres R apart: V = 2 (4/3 pi R^3) - pi (4 R + R) (2 R - R)^2 / 12.
TEST(Clump, OverlapVolumeIsTheLens) {
    Clump const clump = *make_clump(shaped("0,0,0,1\n1,0,0,1\n"));
    double const unit = 8 * pi / 3 - 5 * pi / 12;
    EXPECT_NEAR(clump.spheres[0].radius, std::cbrt(clump.volume / unit), grid * clump.spheres[0].radius);
}

TEST(Clump, TiltedShapesHaveProductsOfInertia) {
    // A rod along the diagonal of x and y: I_xy = -(sum of m x y) < 0, and about that axis the least moment.
    Clump const clump = *make_clump(shaped("1,1,0,1\n-1,-1,0,1\n"));
    EXPECT_LT(clump.inertia[1], -0.1 * clump.inertia[0]);
    EXPECT_NEAR(clump.inertia[2], 0, 1e-6 * clump.inertia[0]);
}

TEST(Clump, PlateHasNineSpheres) {
    Clump const plate = *make_plate(3e-3);
    EXPECT_EQ(plate.spheres.size(), 9u);
    EXPECT_NEAR(plate.volume, 9 * pi / 6 * 27e-9, 1e-20);
    EXPECT_NEAR(plate.smallest_radius, 1.5e-3, grid * 1.5e-3);
}

// The integrals of a shape are kept: they are those of the shape, whatever the diameter.
TEST(Clump, GrowsWithTheDiameter) {
    scenario::Grains const grains = shaped("0,0,0,1\n1,0,0,1\n");
    scenario::Grains larger = grains;
    larger.diameter *= 2;
    EXPECT_DOUBLE_EQ(make_clump(larger)->volume, 8 * make_clump(grains)->volume);
    EXPECT_NE(make_clump(grains)->inertia, make_clump(shaped("0,0,0,1\n2,0,0,1\n"))->inertia);
}

}  // namespace
}  // namespace vibrotrough::prepare
