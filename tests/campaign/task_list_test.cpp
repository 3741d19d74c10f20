#include "campaign/execute/task_list.hpp"

#include "campaign/execute/ranks.hpp"
#include "campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "deck/estimates.hpp"

#include <algorithm>

namespace vibrotrough::campaign {
namespace {

class Tasks : public CampaignFolder {
  protected:
    std::vector<PackingOrder> orders(int packings, int cycles) const {
        std::vector<PackingOrder> all;
        for (int i = 1; i <= packings; ++i) {
            deck::PackingPlan packing{};
            packing.number = i;
            packing.cycles = cycles;
            all.push_back({&planned, packing});
        }
        return all;
    }
    static std::vector<std::size_t> sizes(std::vector<Task> const& tasks) {
        std::vector<std::size_t> all;
        for (Task const& task : tasks) all.push_back(task.size());
        return all;
    }
};

// A packing takes the work of settling and of its cycles over the speed.
TEST_F(Tasks, TakeAsManyPackingsAsFitIntoTheirDuration) {
    double const work = deck::work_of(*planned.prepared, 1, 24);
    TaskSize size{{}, work / 60, 1};  // a minute per packing
    EXPECT_DOUBLE_EQ(expected_time(orders(1, 24)[0], size), 60);
    EXPECT_EQ(sizes(make_tasks(orders(7, 24), size)), std::vector<std::size_t>(7, 1));
    size.duration = 180.5;
    EXPECT_EQ(sizes(make_tasks(orders(7, 24), size)), (std::vector<std::size_t>{3, 3, 1}));
    size.duration = 59;
    EXPECT_EQ(sizes(make_tasks(orders(3, 24), size)), std::vector<std::size_t>(3, 1))
        << "each is longer by itself";
    EXPECT_TRUE(make_tasks({}, size).empty());
    // 0 cycles: as many as the campaign file allows.
    EXPECT_DOUBLE_EQ(expected_time(orders(1, 0)[0], size),
                     deck::work_of(*planned.prepared, 1, planned.scenario().measure.max_cycles) / size.speed);
}

// A task with room for several engines gets a packing for each of them, and with a duration as many as fit
// into it on all its cores.
TEST_F(Tasks, KeepSeveralEnginesBusy) {
    double const work = deck::work_of(*planned.prepared, 1, 24);
    TaskSize size{{}, work / 60, 1, 3};  // a minute per packing
    EXPECT_EQ(sizes(make_tasks(orders(7, 24), size)), (std::vector<std::size_t>{3, 3, 1}));
    size.duration = 120.5;
    EXPECT_EQ(sizes(make_tasks(orders(7, 24), size)), (std::vector<std::size_t>{6, 1}));
    size.duration = 1;
    EXPECT_EQ(sizes(make_tasks(orders(4, 24), size)), (std::vector<std::size_t>{3, 1}));
}

TEST_F(Tasks, CountOnSeveralRanksAsFarAsTheyWereMeasured) {
    int const grains = planned.scenario().layer.grains;
    TaskSize const size{{}, 1, 2};
    EXPECT_DOUBLE_EQ(deck::work_of(*planned.prepared, 1, 24) / expected_time(orders(1, 24)[0], size),
                     std::max(1.0, 2 * parallel_efficiency(grains / 2.0)));
}

TEST_F(Tasks, KeepTheOrderAndComeBackFromTheirList) {
    TaskSize const size{1e12, 1, 1};
    std::vector<Task> const tasks = make_tasks(orders(1000, 24), size);
    ASSERT_EQ(sizes(tasks), (std::vector<std::size_t>{most_packings_per_task}));
    for (std::size_t i = 0; i < tasks[0].size(); ++i)
        EXPECT_EQ(tasks[0][i], (PackingId{planned.id, static_cast<int>(i) + 1}));
    std::filesystem::path const list = folder / "tasks.txt";
    std::filesystem::create_directories(folder);
    core::write_file_atomically(list, write_task_list(tasks));
    EXPECT_EQ(read_task_list(list), tasks);
    EXPECT_EQ(read_task(list, 0), tasks[0]);
    core::write_file_atomically(list, "");
    EXPECT_EQ(read_task_list(list), std::vector<Task>{});
}

}  // namespace
}  // namespace vibrotrough::campaign
