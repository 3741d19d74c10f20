#include "campaign/schedule/forecast.hpp"

#include "campaign_folder.hpp"

namespace vibrotrough::campaign {
namespace {

using ForecastTest = CampaignFolder;

// The speed of the engine is the work of the results over the time that they took: half the time is twice the
// speed, and half the cost of what is missing.
TEST_F(ForecastTest, SpeedIsTheWorkOfTheResultsOverTheirTime) {
    PlannedCase const& one = planned;
    auto const with_result = [&](double core_time) {
        CaseOverview const known{&one, CaseStatus::ended, {}, "", 2, ResultFacts{2, 60, core_time, 0.01}};
        CaseOverview const open{&one, CaseStatus::open, {}, "", 0, {}};
        return forecast({known, open});
    };
    Forecast const slow = with_result(20), fast = with_result(10);
    EXPECT_EQ(slow.results, 1);
    EXPECT_DOUBLE_EQ(slow.speed, planned.prepared->work(60) / 20);
    EXPECT_DOUBLE_EQ(fast.speed, 2 * slow.speed);
    EXPECT_GT(slow.core_time, 0);
    EXPECT_DOUBLE_EQ(fast.core_time, slow.core_time / 2);
}

}  // namespace
}  // namespace vibrotrough::campaign
