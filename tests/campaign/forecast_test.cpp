#include "campaign/schedule/machine_speed.hpp"
#include "campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/temporary_folder.hpp"
#include "deck/campaign_check.hpp"
#include "deck/estimates.hpp"

#include <cstdlib>

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
    EXPECT_DOUBLE_EQ(slow.speed, deck::work_of(*planned.prepared, 0, 60) / 20);
    EXPECT_DOUBLE_EQ(fast.speed, 2 * slow.speed);
    EXPECT_GT(slow.core_time, 0);
    EXPECT_DOUBLE_EQ(fast.core_time, slow.core_time / 2);
}

// A campaign without results costs what the last one showed: 3e8 grain-steps in 100 s. A run
// of a few seconds shows nothing, and a damaged note is none.
TEST_F(ForecastTest, SpeedOfTheLastCampaignCountsUntilThereAreResults) {
    core::TemporaryFolder const cache("cache");
    ::setenv("XDG_CACHE_HOME", cache.path().c_str(), 1);
    CaseOverview const open{&planned, CaseStatus::open, {}, "", 0, {}};
    EXPECT_EQ(forecast({open}).speed, deck::usual_speed);
    EXPECT_FALSE(forecast({open}).is_of_last_campaign);
    note_machine_speed({.driven = 3e8, .core_time = 100});
    note_machine_speed({.driven = 3e6, .core_time = 2});
    note_machine_speed({.driven = 9e8, .core_time = 100, .is_plain = false});
    EXPECT_DOUBLE_EQ(forecast({open}).speed, 3e6);
    EXPECT_TRUE(forecast({open}).is_of_last_campaign);
    for (char const* damaged : {"", "{}", "{\"grain_steps_per_s\": -1}", "{\"grain_steps_per_s\": 1e99}"}) {
        core::write_file_atomically(cache.path() / "vibrotrough" / "speed.json", damaged);
        EXPECT_EQ(machine_speed().grain_steps, deck::usual_speed) << damaged;
    }
    ::unsetenv("XDG_CACHE_HOME");
}

// `check` and `plan` say the same of a campaign without results.
TEST_F(ForecastTest, PlanCostsWhatCheckSays) {
    deck::CampaignCheck const check = deck::check_campaign(scenario::parse_campaign(campaign_text, "c.toml"));
    std::vector<CaseOverview> cases;
    for (PlannedCase const& one : plan.cases) cases.push_back({&one, CaseStatus::open, {}, "", 0, {}});
    EXPECT_NEAR(forecast(cases).core_time, check.work / machine_speed().grain_steps, 1e-9 * check.work);
}

// The progress of a run that has done a quarter of its work, at a speed and on cores of its own.
TEST(TimeToGo, FollowsFromWhatWasDone) {
    WorkOfRun const work{3000, 1000, 800, 20};
    TimeToGo const left = time_to_go(work, 10);
    EXPECT_DOUBLE_EQ(left.wall, 30);
    EXPECT_DOUBLE_EQ(left.core, 3000 / (800 / 20.0));
    EXPECT_LT(time_to_go({3000, 0, 0, 20}, 10).wall, 0) << "nothing is known yet";
    EXPECT_LT(time_to_go(work, 0.5).core, 0);
}

}  // namespace
}  // namespace vibrotrough::campaign
