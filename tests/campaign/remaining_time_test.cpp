#include "campaign/schedule/remaining_time.hpp"

#include "campaign_folder.hpp"

#include <thread>

namespace vibrotrough::campaign {
namespace {

using RemainingTimeTest = CampaignFolder;

TEST_F(RemainingTimeTest, IsUnknownAtFirst) {
    RemainingTime time;
    EXPECT_LT(time.seconds(0), 0);
    time.expect(planned.prepared->grain_steps(24));
    EXPECT_LT(time.seconds(0), 0);
    double const seconds = time.seconds(planned.prepared->grain_steps(5));
    // A busy machine may let this test wait here for longer than that.
    if (time.elapsed() < 1) {
        EXPECT_LT(seconds, 0) << "in less than a second no speed is known";
    }
}

TEST_F(RemainingTimeTest, FollowsTheSpeedSoFar) {
    RemainingTime time;
    auto const cycles = [&](double number) { return planned.prepared->grain_steps(number); };
    time.expect(cycles(160));
    while (time.elapsed() < 1) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_LT(time.seconds(0), 0) << "nothing done, nothing known";

    // 40 cycles are done and 20 more are under way; 100 are left, so t = elapsed * 100 / 60. The clock runs
    // between the calls.
    time.done(cycles(40));
    time.expect(-cycles(40));
    double const before = time.elapsed();
    double const seconds = time.seconds(cycles(20));
    EXPECT_GE(seconds, before * 100 / 60 * (1 - 1e-12));
    EXPECT_LE(seconds, time.elapsed() * 100 / 60 * (1 + 1e-12));

    // When less is needed than was expected, nothing negative is left.
    time.expect(-cycles(80));
    double const dropped = time.seconds(cycles(20));
    EXPECT_GE(dropped, before * 20 / 60 * (1 - 1e-12));
    EXPECT_LE(dropped, time.elapsed() * 20 / 60 * (1 + 1e-12));
    EXPECT_EQ(time.seconds(cycles(90)), 0);
}

TEST_F(RemainingTimeTest, CountsWhatWasSpentOnSettlingOnceAPacking) {
    RemainingTime time;
    auto const cycles = [&](double number) { return planned.prepared->grain_steps(number); };
    time.expect(cycles(100));  // four packings of 25 cycles
    while (time.elapsed() < 1) std::this_thread::sleep_for(std::chrono::milliseconds(10));

    // A deep layer settled for 6 s, and its trough has moved for 4 s and 2 cycles, on one engine (elapsed =
    // 10 s, here in other units): 98 cycles take 98 * 4 / 2 s, and three further packings settle for 3 * 6 s.
    // Without the difference between the two it would be 98 * 10 / 2 s.
    PackingTime const running{6, 4, 1};
    double const before = time.elapsed();
    double const seconds = time.seconds(cycles(2), running, 3);
    double const wanted = (98 * 4 / 2. + 3 * 6) / 10;
    EXPECT_GE(seconds, before * wanted * (1 - 1e-12));
    EXPECT_LE(seconds, time.elapsed() * wanted * (1 + 1e-12));

    // The same when it is done, and while the next one still settles, for 2 s: two are left that have not
    // begun.
    time.done(cycles(25), {6, 50, 1});
    time.expect(-cycles(25));
    double const later = time.elapsed();
    double const left = time.seconds(0, {2, 0, 0}, 2);
    double const wanted_later = (75 * 50 / 25. + 2 * (6 + 2)) / 58;
    EXPECT_GE(left, later * wanted_later * (1 - 1e-12));
    EXPECT_LE(left, time.elapsed() * wanted_later * (1 + 1e-12));
}

}  // namespace
}  // namespace vibrotrough::campaign
