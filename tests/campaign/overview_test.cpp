#include "campaign/state/overview.hpp"

#include "campaign/state/file_lock.hpp"
#include "campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "store/result_file.hpp"
#include "store/sample_record.hpp"

#include <chrono>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

class Overview : public CampaignFolder {
  protected:
    Overview() { fs::create_directories(folder); }
    CaseOverview look() const { return survey(plan, {has_driver(folder), {}}).at(0); }
};

TEST_F(Overview, OpenThenRunningThenInterrupted) {
    EXPECT_EQ(look().label(), "open");
    EXPECT_EQ(look().packings_done, 0);
    fs::create_directories(planned.folder);
    EXPECT_EQ(look().label(), "open") << "prepared, and not started";
    {
        FileLock const driver = lock_campaign(folder);
        EXPECT_EQ(look().label(), "open") << "a driver that has not come to this case";
        write_packing(2, "cycles");
        EXPECT_EQ(look().label(), "open") << "one packing is done, none runs";
        fs::create_directories(planned.packing_folder(1));
        EXPECT_EQ(look().label(), "running") << "a packing without its marker";
    }
    EXPECT_EQ(look().label(), "interrupted");
    EXPECT_EQ(look().packings_done, 1);
    fs::remove_all(planned.packing_folder(1));
    EXPECT_EQ(look().label(), "open") << "what was begun has ended";
    EXPECT_FALSE(look().result);
}

TEST_F(Overview, FailureUntilItIsTriedAgain) {
    write_failure(planned, {core::Outcome::lost_grains, "3 grains left the box", 1, 1});
    EXPECT_EQ(look().label(), "lost-grains");
    EXPECT_EQ(look().message, "3 grains left the box");
    FileLock const driver = lock_campaign(folder);
    EXPECT_EQ(look().label(), "lost-grains") << "also while other cases run";
    fs::remove(planned.failure_file());  // what the driver does when it tries again
    fs::create_directories(planned.packing_folder(1));
    EXPECT_EQ(look().label(), "running");
    EXPECT_EQ(look().message, "");
}

TEST_F(Overview, ResultSaysTheOutcome) {
    fs::create_directories(planned.folder);
    write_failure(planned, {core::Outcome::lost_grains, "3 grains left the box", 1, 1});
    store::write_result(planned.result_file(), store::sample_record(planned.id));
    FileLock const driver = lock_campaign(folder);
    EXPECT_EQ(look().label(), "not-precise");  // the sample's
    EXPECT_EQ(look().message.find("needs about "), 0u) << look().message;
    EXPECT_EQ(look().packings_done, 2);
    store::CaseRecord const sample = store::sample_record(planned.id);
    ASSERT_TRUE(look().result);
    EXPECT_EQ(look().result->packings, 2);
    double core_time = 0, cycles = 0;
    for (store::PackingRecord const& packing : sample.packings) {
        core_time += packing.core_time;
        cycles += packing.estimate.discarded + packing.estimate.measured;
    }
    EXPECT_EQ(look().result->core_time, core_time);
    EXPECT_EQ(look().result->cycles, cycles);
}

// The summary of a result is seen once, with the overview that is returned for its case.
TEST_F(Overview, ShowsEachResultOnce) {
    int seen = 0;
    auto const see = [&](std::size_t i, CaseOverview const& one, store::CaseRecord const* record) {
        EXPECT_EQ(i, 0u);
        EXPECT_EQ(one.planned, &plan.cases.front());
        if (record != nullptr) ++seen;
    };
    survey(plan, {}, see);
    EXPECT_EQ(seen, 0);
    fs::create_directories(planned.folder);
    store::write_result(planned.result_file(), store::sample_record(planned.id));
    survey(plan, {}, [&](std::size_t i, CaseOverview const& one, store::CaseRecord const* record) {
        see(i, one, record);
        ASSERT_NE(record, nullptr);
        EXPECT_EQ(record->estimate.mean, 0.82);
    });
    EXPECT_EQ(seen, 1);
}

TEST_F(Overview, CampaignFileHoldsWhatThereIs) {
    write_campaign_file(plan);  // nothing finished yet: an empty table, not an error
    std::string const empty = core::read_file(folder / "campaign.h5");
    EXPECT_TRUE(empty.starts_with("\x89HDF\r\n"));
    fs::create_directories(planned.folder);
    store::write_result(planned.result_file(), store::sample_record(planned.id));
    write_campaign_file(plan);
    std::string const one = core::read_file(folder / "campaign.h5");
    EXPECT_NE(one, empty);
    EXPECT_NE(one.find(planned.id), std::string::npos);
    write_campaign_file(plan);
    EXPECT_EQ(core::read_file(folder / "campaign.h5"), one) << "the same cases give the same bytes";
}

// Figures need the swept keys of today: a file that was written for others is written again.
TEST_F(Overview, CampaignFileOfOtherSweptKeysIsOutdated) {
    fs::create_directories(planned.folder);
    store::write_result(planned.result_file(), store::sample_record(planned.id));
    write_campaign_file(plan);
    EXPECT_FALSE(is_campaign_file_outdated(plan));
    plan.swept = {scenario::find_key("grains.friction")};
    EXPECT_TRUE(is_campaign_file_outdated(plan));
    write_campaign_file(plan);
    EXPECT_FALSE(is_campaign_file_outdated(plan));
    core::write_file_atomically(folder / "campaign.h5", "damaged");
    EXPECT_TRUE(is_campaign_file_outdated(plan));
}

TEST_F(Overview, CampaignFileSaysInWhatItIsOutdated) {
    fs::path const file = folder / "campaign.h5";
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::missing);
    EXPECT_FALSE(is_campaign_file_outdated(plan)) << "nothing to write";
    core::write_file_atomically(file, "damaged");
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::up_to_date) << "nothing that it could lack";
    fs::create_directories(planned.folder);
    store::write_result(planned.result_file(), store::sample_record(planned.id));
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::outdated);
    fs::remove(file);
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::missing);
    EXPECT_TRUE(is_campaign_file_outdated(plan));
    write_campaign_file(plan);
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::up_to_date);
    plan.swept = {scenario::find_key("grains.friction")};
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::outdated);
    EXPECT_TRUE(is_campaign_file_outdated(plan));
}

// cp -p, rsync -a and tar keep a result's time, which is then older than campaign.h5; a clock that was wrong
// makes it younger for good.
TEST_F(Overview, CampaignFileIsComparedByWhatItHoldsAndNotByTimes) {
    fs::path const file = folder / "campaign.h5";
    write_campaign_file(plan);
    fs::create_directories(planned.folder);
    store::write_result(planned.result_file(), store::sample_record(planned.id));
    fs::last_write_time(planned.result_file(), fs::last_write_time(file) - std::chrono::hours(24));
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::outdated);
    EXPECT_TRUE(is_campaign_file_outdated(plan));
    write_campaign_file(plan);
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::up_to_date);
    fs::last_write_time(planned.result_file(), fs::last_write_time(file) + std::chrono::hours(24 * 365));
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::up_to_date);
    store::CaseRecord other = store::sample_record(planned.id);
    *other.estimate.mean += 0.01;
    store::write_result(planned.result_file(), other);
    fs::last_write_time(planned.result_file(), fs::last_write_time(file) - std::chrono::hours(24));
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::outdated);
}

}  // namespace
}  // namespace vibrotrough::campaign
