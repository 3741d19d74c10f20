#include "measure/stage_means.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

// The first stage has two cycles of a ramp and four behind it, of which the last two give its speed; the
// second stage has no ramp, and the last of its three cycles.
TEST(StageMeans, SpeedsAreThoseAtTheEndsOfTheStages) {
    std::vector<StageCycles> const stages{{0, 2, 6}, {6, 0, 3}};
    StagedVelocities const velocities{{1, 1, 1, 1, 1, 1, 0.5, 0.5, 0.5},
                                      {{8, 8, 16, 16, 1, 3, 5, 6, 7}, {8, 8, 16, 16, 2, 4, 5, 6, 9}}};
    std::vector<StageMeans> const means = measure_stages(stages, velocities, 0.95);
    ASSERT_EQ(means.size(), 2u);
    EXPECT_EQ(means[0].speed.values, (std::vector<double>{2, 3}));
    EXPECT_EQ(means[0].change.values, (std::vector<double>{2, 2}));
    EXPECT_EQ(means[0].distance.values, (std::vector<double>{52, 54}));
    EXPECT_EQ(means[1].speed.values, (std::vector<double>{7, 9}));
    EXPECT_EQ(means[1].distance.values, (std::vector<double>{9, 10}));
}

// The speed grows linearly from 0 to 1 over ten cycles of a second and stays there; a value counts at the
// middle of its cycle, so that 95 % are reached at 9.5 s + 0.5 s.
TEST(StageMeans, TheTimeToTheSpeedIsInterpolated) {
    std::vector<double> velocity(30, 1);
    for (std::size_t i = 0; i < 10; ++i) velocity[i] = 0.1 * static_cast<double>(i);
    EXPECT_NEAR(time_to_speed({0, 0, 30}, velocity, std::vector<double>(30, 1), 0), 10, 1e-12);
}

}  // namespace
}  // namespace vibrotrough::measure
