#include "campaign/schedule/remaining_time.hpp"

#include "campaign_folder.hpp"

#include <thread>

namespace vibrotrough::campaign {
namespace {

using RemainingTimeTest = CampaignFolder;

TEST_F(RemainingTimeTest, IsUnknownAtFirst) {
    RemainingTime time;
    EXPECT_LT(time.seconds(0), 0);
    time.expect(*planned.prepared);
    EXPECT_LT(time.seconds(0), 0);
    double const seconds = time.seconds(planned.prepared->grain_steps(5));
    // A busy machine may let this test wait here for longer than that.
    if (time.elapsed() < 1) {
        EXPECT_LT(seconds, 0) << "in less than a second no speed is known";
    }
}

TEST_F(RemainingTimeTest, FollowsTheSpeedSoFar) {
    RemainingTime time;
    for (int packing = 0; packing < 4; ++packing) time.expect(*planned.prepared);
    while (time.elapsed() < 1) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_LT(time.seconds(0), 0) << "nothing done, nothing known";

    // A packing of 40 cycles is done and another is at cycle 20: the first took two thirds of the time, and
    // what is left is half a packing and two whole ones, 100 cycles; t = elapsed * 100 / 60. The clock runs
    // between the calls.
    time.done(*planned.prepared, 40);
    double const before = time.elapsed();
    double const seconds = time.seconds(planned.prepared->grain_steps(20));
    EXPECT_GE(seconds, before * 100 / 60 * (1 - 1e-12));
    EXPECT_LE(seconds, time.elapsed() * 100 / 60 * (1 + 1e-12));

    // Packings that will not be run no longer count; a packing that takes longer than the others leaves
    // nothing negative behind.
    time.drop(*planned.prepared);
    time.drop(*planned.prepared);
    double const dropped = time.seconds(planned.prepared->grain_steps(20));
    EXPECT_GE(dropped, before * 20 / 60 * (1 - 1e-12));
    EXPECT_LE(dropped, time.elapsed() * 20 / 60 * (1 + 1e-12));
    EXPECT_EQ(time.seconds(planned.prepared->grain_steps(90)), 0);
}

}  // namespace
}  // namespace vibrotrough::campaign
