#include "campaign/schedule/time_to_go.hpp"

#include "campaign_folder.hpp"

#include <thread>

namespace vibrotrough::campaign {
namespace {

using TimeToGoTest = CampaignFolder;

TEST_F(TimeToGoTest, WorkIsGrainSteps) {
    TimeToGo const time;
    double const steps = deck::choose_time_step(scenario).steps_per_cycle;
    EXPECT_DOUBLE_EQ(time.work(scenario, 10), scenario.layer.grains * steps * 10);
    EXPECT_EQ(time.work(scenario, 0), 0);
}

// A cube of eight spheres costs eight spheres.
TEST_F(TimeToGoTest, AClumpCostsItsSpheres) {
    TimeToGo const time;
    scenario.grains.shape = "cube";
    double const steps = deck::choose_time_step(scenario).steps_per_cycle;
    EXPECT_DOUBLE_EQ(time.work(scenario, 10), 8 * scenario.layer.grains * steps * 10);
}

TEST_F(TimeToGoTest, IsUnknownAtFirst) {
    TimeToGo time;
    EXPECT_LT(time.seconds(0), 0);
    time.expect(scenario);
    EXPECT_LT(time.seconds(0), 0);
    EXPECT_LT(time.seconds(time.work(scenario, 5)), 0) << "in less than a second no speed is known";
}

TEST_F(TimeToGoTest, FollowsTheSpeedSoFar) {
    TimeToGo time;
    for (int packing = 0; packing < 4; ++packing) time.expect(scenario);
    while (time.elapsed() < 1) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_LT(time.seconds(0), 0) << "nothing done, nothing known";

    // A packing of 40 cycles is done and another is at cycle 20: the first took two thirds of the time, and
    // what is left is half a packing and two whole ones, 100 cycles; t = elapsed * 100 / 60. The clock runs
    // between the calls.
    time.done(scenario, 40);
    double const before = time.elapsed();
    double const seconds = time.seconds(time.work(scenario, 20));
    EXPECT_GE(seconds, before * 100 / 60 * (1 - 1e-12));
    EXPECT_LE(seconds, time.elapsed() * 100 / 60 * (1 + 1e-12));

    // Packings that will not be run no longer count; a packing that takes longer than the others leaves
    // nothing negative behind.
    time.drop(scenario);
    time.drop(scenario);
    double const dropped = time.seconds(time.work(scenario, 20));
    EXPECT_GE(dropped, before * 20 / 60 * (1 - 1e-12));
    EXPECT_LE(dropped, time.elapsed() * 20 / 60 * (1 + 1e-12));
    EXPECT_EQ(time.seconds(time.work(scenario, 90)), 0);
}

}  // namespace
}  // namespace vibrotrough::campaign
