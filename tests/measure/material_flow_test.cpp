#include "measure/material_flow.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

/// A bin with heavy grains of 4 g and light ones of 1 g: their numbers, speeds (m/s) and heights (m).
Bin bin(double position, double heavy, double light, double heavy_speed, double light_speed, double heavy_z,
        double light_z) {
    double const grains = heavy + light, speed = (heavy * heavy_speed + light * light_speed) / grains;
    return {position,
            grains,
            0,
            {speed, 0.004 * heavy / grains, 0.004 * heavy * heavy_speed / grains,
             0.004 * heavy * heavy_z / grains, 0.001 * light / grains, 0.001 * light * light_speed / grains,
             0.001 * light * light_z / grains}};
}

std::vector<double> const depth{0.01, 0.02, 0.04};
MixtureFacts const mixture_facts{{1, 3}, 0.15, 0.4};

std::vector<Snapshot> snapshots() {
    return {{100,
             {bin(0.1, 1, 4, 0.1, 0.2, 5e-3, 5e-3), bin(0.2, 1, 4, 0.2, 0.4, 5e-3, 9e-3),
              bin(0.3, 1, 0, 0.3, 0, 5e-3, 0)}},
            {200,
             {bin(0.1, 1, 4, 0.1, 0.2, 5e-3, 5e-3), bin(0.2, 3, 4, 0.2, 0.4, 5e-3, 9e-3),
              bin(0.3, 1, 0, 0.5, 0, 7e-3, 0)}}};
}

// share = m / (sum of m); S = (z - z_others) / (h / 2), with sums over both snapshots.
TEST(MaterialFlow, RowsAreBinsOfOneMaterialAfterTheOther) {
    MaterialsAlong const along = materials_along(snapshots(), mixture_facts, depth);
    ASSERT_EQ(along.x.size(), 6u);
    EXPECT_EQ(along.x[4], 0.2);
    EXPECT_NEAR(along.share[0], 0.5, 1e-14);
    EXPECT_NEAR(along.share[1], 16.0 / 24, 1e-14);
    EXPECT_NEAR(along.share[4], 8.0 / 24, 1e-14);
    EXPECT_NEAR(along.speed[1], 0.2, 1e-14);
    EXPECT_NEAR(along.speed[2], 0.4, 1e-14);
    EXPECT_NEAR(along.segregation[0], 0, 1e-14);
    EXPECT_NEAR(along.segregation[1], -0.4, 1e-12);
    EXPECT_NEAR(along.segregation[4], 0.4, 1e-12);
}

TEST(MaterialFlow, WhereAMaterialIsAloneNothingIsSaidOfTheOther) {
    MaterialsAlong const along = materials_along(snapshots(), mixture_facts, depth);
    EXPECT_EQ(along.share[2], 1);
    EXPECT_EQ(along.share[5], 0);
    for (double const unknown : {along.segregation[2], along.segregation[5], along.speed[5]})
        EXPECT_TRUE(std::isnan(unknown));
}

// In the window lie the bins 0.2 and 0.3. Of the heavy material they hold 2/3 of a depth of 20 mm and a depth
// of 40 mm; its index is known in the first alone.
TEST(MaterialFlow, TheWindowWeighsItsBinsWithTheirMasses) {
    MaterialsAlong const along = materials_along(snapshots(), mixture_facts, depth);
    MaterialFlows const flows = material_flows(along, depth, {}, {}, 1, mixture_facts);
    ASSERT_EQ(flows.speed.size(), 2u);
    EXPECT_NEAR(flows.speed[0], (0.02 * 2 / 3 * 0.2 + 0.04 * 0.4) / (0.02 * 2 / 3 + 0.04), 1e-14);
    EXPECT_NEAR(flows.speed[1], 0.4, 1e-14);
    EXPECT_NEAR(flows.segregation[0], -0.4, 1e-12);
    EXPECT_NEAR(flows.segregation[1], 0.4, 1e-12);
}

TEST(MaterialFlow, OutflowAndResidenceAreThoseOfEachType) {
    std::vector<LeftGrain> const left{{1, 1, 0, 0, 1, 0.004}, {1, 2, 0, 0, 3, 0.001}, {2, 3, 0, 0, 3, 0.001}};
    std::vector<Stay> stays(20, Stay{2.0, 1});
    stays.resize(39, Stay{5.0, 3});  // 19 of the light material: too few
    MaterialFlows const flows = material_flows(materials_along(snapshots(), mixture_facts, depth), depth,
                                               left, stays, 0.5, mixture_facts);
    EXPECT_NEAR(flows.outflow[0], 0.008, 1e-15);
    EXPECT_NEAR(flows.outflow[1], 0.004, 1e-15);
    EXPECT_NEAR(flows.residence_time[0], 2, 1e-15);
    EXPECT_TRUE(std::isnan(flows.residence_time[1]));
}

// A trough in which nothing counts yet has no bins.
TEST(MaterialFlow, WithoutSnapshotsThereIsNothingAlong) {
    MaterialsAlong const along = materials_along({}, mixture_facts, {});
    EXPECT_TRUE(along.x.empty());
    MaterialFlows const flows = material_flows(along, {}, {}, {}, 1, mixture_facts);
    EXPECT_TRUE(std::isnan(flows.speed[0]));
    EXPECT_EQ(flows.outflow[0], 0);
}

}  // namespace
}  // namespace vibrotrough::measure
